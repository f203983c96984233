"""What is shown of a design, as pure records."""
