"""Studies: what accuracy and effects cost, hard cases, and the data that the package ships."""
