/* The C interface as its users have it; ends with 0 when everything is as it must be. */
#include <filpost.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MUST(what)                                                                                 \
    do {                                                                                           \
        if (!(what)) {                                                                             \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #what);                             \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

static const char CL[] = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\n"
                         "GOTO / 1, 2, 3\nFINI\n";
static const char RAISE[] = "CIMFIL/ON,LOADTL\nPOSTN/OUT,G,0,Z,SAFEZF(POSTF(7,4))\n"
                            "DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

static const uint8_t *bytes(const char *text) { return (const uint8_t *)text; }

static void well(filpost_error *error) {
    if (error != NULL) {
        fprintf(stderr, "%s\n", filpost_error_message(error));
        exit(1);
    }
}

/* Frees an error that must have this code in its first diagnostic. */
static void refused(filpost_error *error, const char *code) {
    filpost_diagnostic first;
    MUST(error != NULL);
    MUST(filpost_error_count(error) >= 1);
    MUST(filpost_error_diagnostic(error, 0, &first));
    if (strcmp(first.code, code) != 0) {
        fprintf(stderr, "%s instead of %s: %s\n", first.code, code, first.message);
        exit(1);
    }
    MUST(first.severity == FILPOST_SEVERITY_ERROR && first.hint[0] && first.title[0]);
    MUST(!filpost_error_diagnostic(error, filpost_error_count(error), &first));
    MUST(strstr(filpost_error_json(error), code) != NULL);
    filpost_error_free(error);
}

static filpost_program *mill(void) {
    filpost_builder *builder = filpost_builder_new();
    filpost_program *program = NULL;
    well(filpost_builder_ready(builder, "fanuc-mill"));
    well(filpost_builder_option(builder, "style", "plain"));
    well(filpost_builder_build(builder, &program));
    MUST(program != NULL && filpost_program_warning_count(program) == 0);
    return program;
}

struct heights {
    double above;
    int calls, freed;
};

static int32_t safe_height(void *data, const filpost_value *given, size_t count,
                           filpost_reply *reply) {
    struct heights *heights = data;
    heights->calls++;
    MUST(count == 1 && given[0].kind == FILPOST_VALUE_KIND_NUMBER && given[0].text == NULL);
    if (given[0].number > 90) {
        filpost_reply_error(reply, "this tool is in no drawer");
        return 1;
    }
    filpost_reply_number(reply, heights->above + given[0].number);
    return 0;
}

static void freed(void *data) { ((struct heights *)data)->freed++; }

struct seen {
    char text[4096];
    int count, most, from_fil, x_line;
};

static int32_t take(const filpost_block *block, void *data) {
    struct seen *seen = data;
    size_t i;
    strcat(strcat(seen->text, block->text), "\n");
    for (i = 0; i < block->fil_count; i++) {
        seen->from_fil |= strcmp(block->fil[i].file, "raise.fil") == 0 && block->fil[i].line == 2;
    }
    for (i = 0; i < block->word_count; i++) {
        const filpost_block_word *word = &block->words[i];
        MUST(word->start < word->end && word->end <= strlen(block->text));
        if (word->letter == 'X') {
            seen->x_line = (int)word->line;
        }
    }
    return ++seen->count >= seen->most;
}

static void programs_and_runs(void) {
    filpost_program *program = mill();
    filpost_output *output = NULL;
    filpost_diagnostic warning;
    size_t length = 0;
    well(filpost_run(program, bytes(CL), strlen(CL), NULL, &output));
    MUST(strstr(filpost_output_nc(output, &length), "G1 G43 X1. Y2. Z3. F200. H3"));
    MUST(length == strlen(filpost_output_nc(output, NULL)));
    MUST(filpost_output_records(output) == 6 && filpost_output_blocks(output) > 4);
    MUST(filpost_output_warning_count(output) == 0);
    MUST(strcmp(filpost_output_warnings_json(output), "[]") == 0);
    filpost_output_free(output);

    well(filpost_run(program, bytes(CL), strlen(CL) - strlen("FINI\n"), NULL, &output));
    MUST(filpost_output_warning_count(output) == 1);
    MUST(filpost_output_warning(output, 0, &warning));
    MUST(warning.code[0] == 'W' && warning.severity == FILPOST_SEVERITY_WARNING);
    MUST(!filpost_output_warning(output, 1, &warning));
    filpost_output_free(output);
    filpost_program_free(program);
}

static void options(void) {
    static const char bare[] = "LOADTL / 3\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    static const char wrong[] = "UNITS / MM\nBANANA / 1\nFINI\n";
    filpost_program *program = mill();
    filpost_cancel *cancel = filpost_cancel_new();
    filpost_options options = {NULL, NULL, "mm", NULL};
    filpost_output *output = NULL;
    filpost_diagnostic first;
    filpost_error *error;
    MUST((error = filpost_run(program, bytes(bare), strlen(bare), NULL, &output)) != NULL);
    filpost_error_free(error);
    well(filpost_run(program, bytes(bare), strlen(bare), &options, &output));
    filpost_output_free(output);

    options.cl_name = "part.ncl";
    MUST((error = filpost_run(program, bytes(wrong), strlen(wrong), &options, &output)) != NULL);
    MUST(output == NULL && filpost_error_diagnostic(error, 0, &first));
    MUST(strcmp(first.file, "part.ncl") == 0 && first.line == 2 && first.column == 1);
    filpost_error_free(error);

    options.units = "furlong";
    refused(filpost_run(program, bytes(CL), strlen(CL), &options, &output), "USAGE");
    options.units = NULL;
    options.dialect = "surfcam";
    refused(filpost_run(program, bytes(CL), strlen(CL), &options, &output), "USAGE");
    options.dialect = "nx";
    options.cancel = cancel;
    filpost_cancel_cancel(cancel);
    MUST((error = filpost_run(program, bytes(CL), strlen(CL), &options, &output)) != NULL);
    MUST(filpost_error_is_cancelled(error));
    filpost_error_free(error);
    filpost_cancel_free(cancel);
    filpost_program_free(program);
}

static void functions(void) {
    static const char no_tool[] = "UNITS / MM\nLOADTL / 99\nFINI\n";
    struct heights heights = {100, 0, 0};
    filpost_builder *builder = filpost_builder_new();
    filpost_program *program = NULL;
    filpost_output *output = NULL;
    filpost_diagnostic first;
    filpost_error *error;
    struct seen seen;
    refused(filpost_builder_function(builder, "SAFEZF", 1, NULL, &heights, freed), "USAGE");
    MUST(heights.freed == 0);
    well(filpost_builder_function(builder, "SAFEZF", 1, safe_height, &heights, freed));
    well(filpost_builder_fil(builder, "raise.fil", RAISE));
    well(filpost_builder_limit(builder, "fuel", 1000));
    well(filpost_builder_build(builder, &program));
    well(filpost_run(program, bytes(CL), strlen(CL), NULL, &output));
    MUST(strstr(filpost_output_nc(output, NULL), "Z103.") && heights.calls == 1);

    memset(&seen, 0, sizeof seen);
    seen.most = 1000;
    well(filpost_blocks(program, bytes(CL), strlen(CL), NULL, take, &seen));
    MUST(strcmp(seen.text, filpost_output_nc(output, NULL)) == 0);
    MUST(seen.from_fil && seen.x_line == 5);
    filpost_output_free(output);
    memset(&seen, 0, sizeof seen);
    seen.most = 2;
    error = filpost_blocks(program, bytes(CL), strlen(CL), NULL, take, &seen);
    MUST(error != NULL && filpost_error_is_cancelled(error) && seen.count == 2);
    filpost_error_free(error);

    error = filpost_run(program, bytes(no_tool), strlen(no_tool), NULL, &output);
    MUST(error != NULL && filpost_error_diagnostic(error, 0, &first));
    MUST(strstr(first.message, "in no drawer") && strcmp(first.file, "raise.fil") == 0);
    filpost_error_free(error);
    MUST(heights.freed == 0);
    filpost_program_free(program);
    MUST(heights.freed == 1);

    /* A builder that is given up frees the data too. */
    builder = filpost_builder_new();
    well(filpost_builder_function(builder, "SAFEZF", 1, safe_height, &heights, freed));
    filpost_builder_free(builder);
    MUST(heights.freed == 2);
    builder = filpost_builder_new();
    well(filpost_builder_function(builder, "SQRTF", 1, safe_height, &heights, freed));
    refused(filpost_builder_build(builder, &program), "E0229");
    MUST(program == NULL && heights.freed == 3);
}

static void checks(void) {
    filpost_program *program = mill();
    filpost_output *output = NULL;
    filpost_text *told = NULL;
    char changed[4096];
    size_t length;
    const char *nc;
    well(filpost_run(program, bytes(CL), strlen(CL), NULL, &output));
    nc = filpost_output_nc(output, &length);
    well(filpost_verify(program, bytes(CL), strlen(CL), bytes(nc), length, 0, NULL, &told));
    MUST(strstr(filpost_text_get(told), "\"verdict\":\"agrees\""));
    filpost_text_free(told);
    strcpy(changed, nc);
    memcpy(strstr(changed, "Y2."), "Y4.", 3);
    well(filpost_verify(program, bytes(CL), strlen(CL), bytes(changed), length, 0, NULL, &told));
    MUST(strstr(filpost_text_get(told), "\"verdict\":\"differs\""));
    filpost_text_free(told);
    well(filpost_diff(bytes(nc), length, bytes(changed), length, 0.001, &told));
    MUST(strstr(filpost_text_get(told), "\"message\":"));
    filpost_text_free(told);
    well(filpost_diff(bytes(nc), length, bytes(nc), length, 0.001, &told));
    MUST(strcmp(filpost_text_get(told), "[]") == 0);
    filpost_text_free(told);
    refused(filpost_diff(bytes(nc), length, bytes(nc), length, -1, &told), "USAGE");
    MUST(told == NULL);
    filpost_output_free(output);
    filpost_program_free(program);
}

static void wrong_calls(void) {
    filpost_program *program = mill();
    filpost_builder *builder = filpost_builder_new();
    filpost_output *output = NULL;
    refused(filpost_run(NULL, bytes(CL), strlen(CL), NULL, &output), "USAGE");
    refused(filpost_run(program, NULL, 7, NULL, &output), "USAGE");
    refused(filpost_run(program, bytes(CL), strlen(CL), NULL, NULL), "USAGE");
    refused(filpost_run(program, bytes(CL), (size_t)-1, NULL, &output), "USAGE");
    refused(filpost_blocks(program, bytes(CL), strlen(CL), NULL, NULL, NULL), "USAGE");
    refused(filpost_run_files(program, NULL, "out.nc", NULL, NULL), "USAGE");
    refused(filpost_run_files(program, "no such file.ncl", "out.nc", NULL, NULL), "E0701");
    refused(filpost_builder_ready(NULL, "fanuc-mill"), "USAGE");
    refused(filpost_builder_ready(builder, NULL), "USAGE");
    refused(filpost_builder_ready(builder, "\xff\xfe"), "USAGE");
    refused(filpost_builder_limit(builder, "petrol", 1), "USAGE");
    refused(filpost_builder_allow(builder, "E9999"), "E0713");
    filpost_program_free(program);
    refused(filpost_builder_build(NULL, &program), "USAGE");
    MUST(program == NULL);
    well(filpost_builder_ready(builder, "no-such-mill"));
    refused(filpost_builder_build(builder, &program), "E0703");
    refused(filpost_builder_build(filpost_builder_new(), NULL), "USAGE");
    filpost_builder_free(NULL);
    filpost_program_free(NULL);
    filpost_output_free(NULL);
    filpost_error_free(NULL);
    filpost_text_free(NULL);
    filpost_cancel_free(NULL);
    filpost_cancel_cancel(NULL);
    MUST(filpost_error_message(NULL) == NULL && filpost_error_count(NULL) == 0);
    MUST(filpost_output_nc(NULL, NULL) == NULL && filpost_text_get(NULL) == NULL);
}

/* What the answer of a function is to be, and the program it may run itself. */
struct answer {
    enum { NOTHING, BYTES, NO_TEXT, NOT_A_NUMBER, BARE_STATUS, BARE_ERROR, TWO_LINES, NESTED } kind;
    const filpost_program *program;
};

static int32_t answer(void *data, const filpost_value *given, size_t count, filpost_reply *reply) {
    const struct answer *answer = data;
    filpost_output *inner = NULL;
    (void)given;
    (void)count;
    switch (answer->kind) {
    case NOTHING: return 0;
    case BYTES: filpost_reply_text(reply, "\xff\xfe"); return 0;
    case NO_TEXT: filpost_reply_text(reply, NULL); return 0;
    case NOT_A_NUMBER: filpost_reply_number(reply, NAN); return 0;
    case BARE_STATUS: return -7;
    case BARE_ERROR: filpost_reply_error(reply, NULL); return 0;
    case TWO_LINES: filpost_reply_text(reply, "A\nG0 Z-100."); return 0;
    case NESTED:
        well(filpost_run(answer->program, bytes(CL), strlen(CL), NULL, &inner));
        filpost_reply_number(reply, (double)filpost_output_records(inner));
        filpost_output_free(inner);
        return 0;
    }
    return 1;
}

static void answers(void) {
    static const char script[] = "CIMFIL/ON,LOADTL\nAA=ANSWRF(1)\nPPRINT/AA\nDMY=POSTF(13)\n"
                                 "CIMFIL/OFF\nFINI\n";
    struct answer told = {NOTHING, NULL};
    filpost_builder *builder = filpost_builder_new();
    filpost_program *program = NULL, *inner = mill();
    filpost_output *output = NULL;
    filpost_error *error;
    int kind;
    well(filpost_builder_fil(builder, "answer.fil", script));
    well(filpost_builder_function(builder, "ANSWRF", 1, answer, &told, NULL));
    well(filpost_builder_build(builder, &program));
    for (kind = BYTES; kind <= BARE_ERROR; kind++) {
        told.kind = kind;
        error = filpost_run(program, bytes(CL), strlen(CL), NULL, &output);
        if (error == NULL) {
            fprintf(stderr, "answer %d was taken:\n%s\n", kind, filpost_output_nc(output, NULL));
            exit(1);
        }
        MUST(output == NULL);
        filpost_error_free(error);
    }
    told.kind = TWO_LINES;
    well(filpost_run(program, bytes(CL), strlen(CL), NULL, &output));
    MUST(strstr(filpost_output_nc(output, NULL), "(A G0 Z-100.)") != NULL);
    filpost_output_free(output);
    told.kind = NESTED;
    told.program = inner;
    well(filpost_run(program, bytes(CL), strlen(CL), NULL, &output));
    MUST(strstr(filpost_output_nc(output, NULL), "(6") != NULL);
    filpost_output_free(output);
    filpost_program_free(program);
    filpost_program_free(inner);
}

/* Nothing at all, bytes of a code page, and NULL for each handle. */
static void hostile(void) {
    static const char named[] = "PARTNO / FR\xc4SER\nUNITS / MM\nLOADTL / 3\nFINI\n";
    filpost_program *program = mill();
    filpost_output *output = NULL;
    filpost_text *told = NULL;
    filpost_diagnostic diagnostic;
    filpost_error *error;
    FILE *part;
    char kept[64] = {0};
    error = filpost_run(program, NULL, 0, NULL, &output);
    if (error == NULL) {
        filpost_output_free(output);
    }
    filpost_error_free(error);
    error = filpost_verify(program, NULL, 0, NULL, 0, 0, NULL, &told);
    filpost_error_free(error);
    filpost_text_free(told);
    well(filpost_diff(NULL, 0, NULL, 0, 0, &told));
    MUST(strcmp(filpost_text_get(told), "[]") == 0);
    filpost_text_free(told);
    well(filpost_run(program, bytes(named), strlen(named), NULL, &output));
    MUST(strstr(filpost_output_nc(output, NULL), "FR\xc3\x84SER") != NULL);
    filpost_output_free(output);

    /* A program never takes the place of its CL file. */
    MUST((part = fopen("hostile.ncl", "wb")) != NULL);
    MUST(fputs(CL, part) >= 0 && fclose(part) == 0);
    refused(filpost_run_files(program, "hostile.ncl", "./hostile.ncl", NULL, NULL), "E0702");
    MUST((part = fopen("hostile.ncl", "rb")) != NULL);
    MUST(fgets(kept, sizeof kept, part) && fclose(part) == 0 && strncmp(kept, CL, 10) == 0);
    MUST(remove("hostile.ncl") == 0);

    MUST(filpost_error_json(NULL) == NULL && !filpost_error_is_cancelled(NULL));
    MUST(!filpost_error_diagnostic(NULL, 0, &diagnostic));
    MUST(filpost_output_records(NULL) == 0 && filpost_output_blocks(NULL) == 0);
    MUST(filpost_output_warning_count(NULL) == 0 && !filpost_output_warning(NULL, 0, &diagnostic));
    MUST(filpost_output_warnings_json(NULL) == NULL);
    MUST(filpost_program_warning_count(NULL) == 0);
    MUST(!filpost_program_warning(NULL, 0, &diagnostic));
    MUST(!filpost_program_warning(program, 0, NULL));
    filpost_reply_number(NULL, 1);
    filpost_reply_text(NULL, "text");
    filpost_reply_error(NULL, "text");
    refused(filpost_diff(NULL, 7, NULL, 0, 0, &told), "USAGE");
    refused(filpost_diff(NULL, 0, NULL, 0, 0, NULL), "USAGE");
    refused(filpost_verify(NULL, NULL, 0, NULL, 0, 0, NULL, &told), "USAGE");
    refused(filpost_verify(program, NULL, 0, NULL, 0, NAN, NULL, &told), "USAGE");
    refused(filpost_blocks(program, NULL, 0, NULL, NULL, NULL), "USAGE");
    filpost_program_free(program);
}

/* A post in a folder, a clock, and what a code means. */
static void folders_and_clocks(void) {
    filpost_builder *builder = filpost_builder_new();
    filpost_program *program = NULL;
    filpost_output *output = NULL;
    filpost_text *text;
    const char *nc;

    refused(filpost_builder_folder(builder, "no/such/folder"), "E0701");
    well(filpost_builder_folder(builder, "tests/folder"));
    refused(filpost_builder_clock(builder, "noon"), "USAGE");
    well(filpost_builder_clock(builder, "2026-01-31T12:00:00"));
    well(filpost_builder_build(builder, &program));
    well(filpost_run(program, bytes(CL), strlen(CL), NULL, &output));
    nc = filpost_output_nc(output, NULL);
    MUST(strstr(nc, "(TOOL 3 OF 2026)") != NULL);
    filpost_output_free(output);
    filpost_program_free(program);

    text = filpost_explain("G83");
    MUST(text != NULL && strncmp(filpost_text_get(text), "G83", 3) == 0);
    filpost_text_free(text);
    MUST(filpost_explain("QWXYZ9") == NULL && filpost_explain(NULL) == NULL);
}

int main(void) {
    MUST(strlen(filpost_version()) >= 5);
    programs_and_runs();
    options();
    functions();
    checks();
    folders_and_clocks();
    wrong_calls();
    answers();
    hostile();
    puts("C: all as it must be");
    return 0;
}
