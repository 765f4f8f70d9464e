PYTHON ?= python3
BUILT =

# There is nothing to build; a mistake in the grammar shows here.
all: grammar
grammar:
	@$(PYTHON) -c 'compile(open("@FILE@").read(), "@FILE@", "exec")'
.PHONY: grammar
