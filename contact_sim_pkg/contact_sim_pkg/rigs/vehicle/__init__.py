"""Quarter car and seat, alone or together: rigs tire, seat and car."""
