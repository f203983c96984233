"""The half-rule page: the steps of a reduction."""
