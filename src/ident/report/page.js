// Behaviour of the report page: the theme, and interactive time series where the library is there.
