"""The page of rules: its question, table, pictures, and a word on each rule."""
