// Run while the build is configured: ends with the number of the machine that this computer is.
#include "pendula/kernels/machine.hpp"

int main() { return static_cast<int>(pendula::machine_here()); }
