/* A library that is no controller. */
int something_else(void);
int something_else(void) { return 1; }
