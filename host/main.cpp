#include "host/program.hpp"

int main(int argc, char** argv) { return slagflow::run_program(argc, argv); }
