// The header alone in C++: it declares everything with C linkage.
#include <filpost.h>
#include <cstdio>

int main() {
    filpost_builder *builder = filpost_builder_new();
    filpost_program *program = nullptr;
    filpost_error *error = filpost_builder_build(builder, &program);
    filpost_program_free(program);
    std::puts(error == nullptr ? "header: C++ too" : filpost_error_message(error));
    return error != nullptr;
}
