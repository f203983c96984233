"""Frequency response of a closed loop: log L, crossings, margins and peaks, single and nested."""
