"""The files that a bag consists of: found, unpacked, and each read by what knows its format."""
