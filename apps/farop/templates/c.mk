CFLAGS ?= -O2 -g -Wall -Wextra
BUILT = @LIBRARY@

@LIBRARY@: @FILE@ Makefile
	$(CC) -std=c11 $(CFLAGS) -fPIC -shared -I"$(INCLUDE)" @FILE@ -o $@
