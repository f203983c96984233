"""Output error with exact dead time: responses to the held OP, the linear part projected out, search and refinement."""
