"""Topics of a bag as tables: CSV, Parquet, pressure maps as the CSV of a pressure mat."""
