"""Numbers as people type and paste them: one reading, or a refusal in words."""

from simc_core.numbers.one import read_exact, read_number
from simc_core.numbers.several import read_exact_numbers, read_numbers
