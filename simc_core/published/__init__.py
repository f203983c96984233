"""Published numbers, closed forms and high-precision values, beside ours."""
