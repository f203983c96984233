"""What a fit is worth: noise, standard errors, comparison of structures, verdicts in words, refusals."""
