"""The half rule and what it decides on the way: records, explanation, model error."""
