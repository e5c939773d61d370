"""The MCAP file itself: layout, appending, recovery of an unfinished one."""
