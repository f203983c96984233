"""How transfer functions stand in clipboards: tokens, the grammar, constructor calls, statements with names."""
