"""Many loops: a list of plants in; settings, margins, responses in numbers and advice out, row by row or in batches."""
