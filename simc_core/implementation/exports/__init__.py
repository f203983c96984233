"""The sampled law in the languages of controllers: one list of statements, one module a language."""
