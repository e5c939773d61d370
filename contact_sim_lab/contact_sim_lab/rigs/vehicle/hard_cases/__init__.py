"""Hard cases of tire, seat and car for `bench hard`."""
