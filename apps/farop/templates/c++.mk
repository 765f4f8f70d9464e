CXXFLAGS ?= -O2 -g -Wall -Wextra
BUILT = @LIBRARY@

@LIBRARY@: @FILE@ Makefile
	$(CXX) -std=c++17 $(CXXFLAGS) -fPIC -shared -I"$(INCLUDE)" @FILE@ -o $@
