"""`bench hard`: the hard cases."""
