"""Laboratory of the Contact Bench: hard cases, work and precision, goals, growth, validation, papers,
slow twins, and the generators of pages. It knows the product; the product does not know it.
"""

__version__ = "0.1.0"
