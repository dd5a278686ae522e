#include "commands/program.h"

int main(int argc, char** argv) {
    return diptych::core::app::run_program(argc, argv);
}
