#include "commands/program.h"
#include "console/process_start.h"

int main(int argc, char** argv) {
    diptych::core::app::prepare_process();
    return diptych::core::app::run_program(argc, argv);
}
