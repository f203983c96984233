"""From a trend to a model: records of PV and OP, models fitted with exact dead time, and what they are worth."""
