RUSTFLAGS ?= -O -g
BUILT = @LIBRARY@

@LIBRARY@: @FILE@ Makefile
	rustc $(RUSTFLAGS) --edition 2021 --crate-name rasterizer --crate-type cdylib @FILE@ -o $@
