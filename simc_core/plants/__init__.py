"""The plant: its factors, reduced models, the reader of text, examples, the open-loop step."""
