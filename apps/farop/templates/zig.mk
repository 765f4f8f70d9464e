ZIGFLAGS ?= -O ReleaseSafe
BUILT = @LIBRARY@ @LIBRARY@.o

@LIBRARY@: @FILE@ Makefile
	zig build-lib -dynamic -lc $(ZIGFLAGS) -I"$(INCLUDE)" -femit-bin=$@ @FILE@
