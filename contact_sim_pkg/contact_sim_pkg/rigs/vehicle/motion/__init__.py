"""Kernels of the bodies' motion: quarter car, seat and car, with any part absent."""
