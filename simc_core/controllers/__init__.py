"""PI, PID and I controllers: one type a form."""
