"""Settings of all tests."""

from hypothesis import settings

# the machine is shared: how long one example takes says nothing about the program
settings.register_profile("shared machine", deadline=None)
settings.load_profile("shared machine")
