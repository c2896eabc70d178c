/* Posts a CL file with a function of this program, and says what is wrong with it. */
#include <filpost.h>
#include <stdio.h>
#include <string.h>

static int32_t tool_life(void *data, const filpost_value *given, size_t count, filpost_reply *reply) {
    (void)data, (void)count;
    if (given[0].kind != FILPOST_VALUE_KIND_NUMBER) {
        filpost_reply_error(reply, "a tool number is needed");
        return 1;
    }
    filpost_reply_number(reply, given[0].number == 3 ? 8 : 60);
    return 0;
}

int main(void) {
    const char *fil = "CIMFIL/ON,LOADTL\nLIFE=TLIFEF(POSTF(7,4))\nIF(LIFE.LT.10) STOP\n"
                      "DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    const char *cl = "UNITS / MM\nLOADTL / 3\nFEDRAT / 300, MMPM\nGOTO / 40, 0, 5\nFINI\n";
    filpost_builder *builder = filpost_builder_new();
    filpost_program *program = NULL;
    filpost_output *output = NULL;
    filpost_error *error = filpost_builder_ready(builder, "fanuc-mill");
    if (!error) error = filpost_builder_fil(builder, "life.fil", fil);
    if (!error) error = filpost_builder_function(builder, "TLIFEF", 1, tool_life, NULL, NULL);
    if (!error) {
        error = filpost_builder_build(builder, &program);
        builder = NULL; /* taken */
    }
    if (!error) error = filpost_run(program, (const uint8_t *)cl, strlen(cl), NULL, &output);
    if (!error) fputs(filpost_output_nc(output, NULL), stdout);
    if (error) fprintf(stderr, "%s\n", filpost_error_message(error));
    int status = error != NULL;
    filpost_error_free(error);
    filpost_output_free(output);
    filpost_program_free(program);
    filpost_builder_free(builder);
    return status;
}
