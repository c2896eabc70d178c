/*
 * filpost: CL file and FIL macros in, NC program out.
 *
 * Texts that go in are UTF-8 and end with a NUL, except CL files and NC programs, which come
 * with their length. Texts that come out end with a NUL and live as long as what they
 * were asked of. A function that can fail returns an error that the caller frees with
 * filpost_error_free, or NULL when all went well; what it would have given is then NULL.
 * NULL where a handle is needed is such an error. Freeing NULL does nothing.
 *
 * Made from the sources; do not edit.
 */

#ifndef FILPOST_H
#define FILPOST_H

#include <stddef.h>
#include <stdint.h>
#include <stdbool.h>

/*
 What a value is.
 */
typedef enum filpost_value_kind {
  /*
   EMPTY.
   */
  FILPOST_VALUE_KIND_EMPTY,
  /*
   A number.
   */
  FILPOST_VALUE_KIND_NUMBER,
  /*
   A text.
   */
  FILPOST_VALUE_KIND_TEXT,
} filpost_value_kind;

/*
 How bad a diagnostic is.
 */
typedef enum filpost_severity {
  /*
   The run goes on; the NC program is written.
   */
  FILPOST_SEVERITY_WARNING,
  /*
   There is no NC program.
   */
  FILPOST_SEVERITY_ERROR,
} filpost_severity;

/*
 Collects what a program is made of. One thread at a time uses it.
 */
typedef struct filpost_builder filpost_builder;

/*
 A switch that stops runs from another thread.
 */
typedef struct filpost_cancel filpost_cancel;

/*
 What went wrong, with all its diagnostics. The caller owns it.
 */
typedef struct filpost_error filpost_error;

/*
 An NC program and what its run has to tell. The caller owns it.
 */
typedef struct filpost_output filpost_output;

/*
 A machine with its compiled FIL. It never changes: any number of threads may use it at the
 same time; it is freed when none does.
 */
typedef struct filpost_program filpost_program;

/*
 What a function answers; EMPTY until it is told.
 */
typedef struct filpost_reply filpost_reply;

/*
 A text that the caller owns.
 */
typedef struct filpost_text filpost_text;

/*
 An argument of a function. Its text lives during the call.
 */
typedef struct filpost_value {
  /*
   What it is.
   */
  enum filpost_value_kind kind;
  /*
   The number; 0 of anything else.
   */
  double number;
  /*
   The text; NULL of anything else.
   */
  const char *text;
} filpost_value;

/*
 A function for FIL: gives its answer by `filpost_reply_number` or `filpost_reply_text` and
 returns 0; anything else stops the run, with the sentence of `filpost_reply_error`. Threads
 that share the program call it at the same time, each with the same `user_data`. It must
 not throw and not jump out.
 */
typedef int32_t (*filpost_function)(void *user_data,
                                    const struct filpost_value *arguments,
                                    size_t count,
                                    struct filpost_reply *reply);

/*
 Frees user data; called once, when the last program with the function is freed.
 */
typedef void (*filpost_free_user_data)(void *user_data);

/*
 An error or a warning. Its texts live as long as what it was asked of.
 */
typedef struct filpost_diagnostic {
  /*
   `E0501` or `W0151`; `USAGE` for a wrong call, `FAULT` for a fault of the library.
   */
  const char *code;
  /*
   Error or warning.
   */
  enum filpost_severity severity;
  /*
   What the code means, in a few words.
   */
  const char *title;
  /*
   What is wrong here.
   */
  const char *message;
  /*
   The CL, FIL or machine file; NULL without a place.
   */
  const char *file;
  /*
   Line of the file, from 1; 0 without a place.
   */
  uint32_t line;
  /*
   Column in characters, from 1; 0 without a place.
   */
  uint32_t column;
  /*
   What can be done.
   */
  const char *hint;
} filpost_diagnostic;

/*
 The options of a run; NULL in place of it, and NULL in its fields, are as without.
 */
typedef struct filpost_options {
  /*
   What messages call the CL file.
   */
  const char *cl_name;
  /*
   The dialect of the CL file where it is not recognized, `nx`.
   */
  const char *dialect;
  /*
   `mm` or `inch`, for a CL file that does not say it.
   */
  const char *units;
  /*
   A switch that stops the run.
   */
  const struct filpost_cancel *cancel;
} filpost_options;

/*
 A line of FIL that had a part in a block.
 */
typedef struct filpost_fil_line {
  /*
   The FIL file, as it was named.
   */
  const char *file;
  /*
   Line, from 1.
   */
  uint32_t line;
} filpost_fil_line;

/*
 A word of a block and what made it.
 */
typedef struct filpost_block_word {
  /*
   Its letter; `_` for a text, `/` for block delete, `#` for a sequence number.
   */
  char letter;
  /*
   A FIL statement made the record that `record_word` counts.
   */
  bool made_by_fil;
  /*
   The word of the record, as POSTF(7,n) counts; 0 for the record as a whole.
   */
  uint16_t record_word;
  /*
   Byte in the text of the block where it starts.
   */
  size_t start;
  /*
   Byte behind it and the blank that follows.
   */
  size_t end;
  /*
   Number of the CL record; 0 where the settings of the machine ask for it.
   */
  uint32_t record;
  /*
   Line of the CL file; 0 where the settings of the machine ask for it.
   */
  uint32_t line;
} filpost_block_word;

/*
 A block of an NC program. It lives during the call that it is handed to.
 */
typedef struct filpost_block {
  /*
   Number of the block in the program, from 1.
   */
  uint64_t number;
  /*
   The block, without line end.
   */
  const char *text;
  /*
   Number of the CL record that made it; 0 before the first one.
   */
  uint32_t record;
  /*
   Line of the CL file; 0 before the first record.
   */
  uint32_t line;
  /*
   FIL lines that called one another, innermost first.
   */
  const struct filpost_fil_line *fil;
  /*
   Their number.
   */
  size_t fil_count;
  /*
   The words in order.
   */
  const struct filpost_block_word *words;
  /*
   Their number.
   */
  size_t word_count;
} filpost_block;

/*
 Takes a block; 0 goes on, anything else stops the run.
 */
typedef int32_t (*filpost_take_block)(const struct filpost_block *block, void *user_data);

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 Starts a program; the machine is the generic mill until another is chosen.
 filpost_builder_build takes it, else filpost_builder_free frees it.
 */
struct filpost_builder *filpost_builder_new(void);

/*
 Frees a builder that was not built.

 # Safety
 `builder` is NULL or live, and is not used again.
 */
void filpost_builder_free(struct filpost_builder *builder);

/*
 Chooses a post inside the library, `fanuc-mill`.

 # Safety
 `builder` is live; `name` ends with a NUL.
 */
struct filpost_error *filpost_builder_ready(struct filpost_builder *builder, const char *name);

/*
 Takes the post in a folder: its `machine.toml` and, where there is one, `post.fil`. After an
 error the builder is as new.

 # Safety
 `builder` is live; `folder` ends with a NUL.
 */
struct filpost_error *filpost_builder_folder(struct filpost_builder *builder, const char *folder);

/*
 Takes the text of a `machine.toml`; messages show `name`.

 # Safety
 `builder` is live; `name` and `text` end with a NUL.
 */
struct filpost_error *filpost_builder_machine(struct filpost_builder *builder,
                                              const char *name,
                                              const char *text);

/*
 Takes the text of an option file (UNCX01.Pnn); messages show `name`.

 # Safety
 `builder` is live; `name` and `text` end with a NUL.
 */
struct filpost_error *filpost_builder_option_file(struct filpost_builder *builder,
                                                  const char *name,
                                                  const char *text);

/*
 Lays the settings of a further `machine.toml` over the machine; the later one wins.

 # Safety
 `builder` is live; `name` and `text` end with a NUL.
 */
struct filpost_error *filpost_builder_over(struct filpost_builder *builder,
                                           const char *name,
                                           const char *text);

/*
 Lays one more setting on top, `rapid.split=0`.

 # Safety
 `builder` is live; `setting` ends with a NUL.
 */
struct filpost_error *filpost_builder_set(struct filpost_builder *builder, const char *setting);

/*
 Adds a FIL file; several are read in this order into one name space.

 # Safety
 `builder` is live; `name` and `text` end with a NUL.
 */
struct filpost_error *filpost_builder_fil(struct filpost_builder *builder,
                                          const char *name,
                                          const char *text);

/*
 Refuses extensions of filpost, so that scripts stay portable.

 # Safety
 `builder` is live.
 */
struct filpost_error *filpost_builder_strict(struct filpost_builder *builder, bool strict);

/*
 Allows a code in all FIL files, `W0151`.

 # Safety
 `builder` is live; `code` ends with a NUL.
 */
struct filpost_error *filpost_builder_allow(struct filpost_builder *builder, const char *code);

/*
 Gives an option of the post its value, as `filpost post --option preload=no` does; an option
 that the post lacks is refused when the program is built.

 # Safety
 `builder` is live; `name` and `value` end with a NUL.
 */
struct filpost_error *filpost_builder_option(struct filpost_builder *builder,
                                             const char *name,
                                             const char *value);

/*
 Sets the level of a code, `E0532` or `all`: `allow`, `warn` or `deny`. Levels of single codes
 win over that of all, and both over those of the machine.

 # Safety
 `builder` is live; `code` and `level` end with a NUL.
 */
struct filpost_error *filpost_builder_level(struct filpost_builder *builder,
                                            const char *code,
                                            const char *level);

/*
 Sets what DATEF and TIMEF give: `system` for the time of the run in UTC, or a moment such as
 `2026-01-31T12:00:00`. A script that asks for the time is refused without.

 # Safety
 `builder` is live; `clock` ends with a NUL.
 */
struct filpost_error *filpost_builder_clock(struct filpost_builder *builder, const char *clock);

/*
 Bounds what a run may use up: `fuel` (steps of a section), `call_depth`, `array_elements`,
 `text_bytes` or `output_bytes`.

 # Safety
 `builder` is live; `name` ends with a NUL.
 */
struct filpost_error *filpost_builder_limit(struct filpost_builder *builder,
                                            const char *name,
                                            uint64_t most);

/*
 Adds a function to FIL. `free_user_data`, where there is one, is called when no program
 needs `user_data` any more; after an error it is not called.

 # Safety
 `builder` is live; `name` ends with a NUL; `function` and `user_data` may be used from any
 thread until `free_user_data` is called.
 */
struct filpost_error *filpost_builder_function(struct filpost_builder *builder,
                                               const char *name,
                                               uint16_t arguments,
                                               filpost_function function,
                                               void *user_data,
                                               filpost_free_user_data free_user_data);

/*
 Builds the program into `program`, and frees the builder whether it goes well or not.

 # Safety
 `builder` is live and not used again; `program` may be written to.
 */
struct filpost_error *filpost_builder_build(struct filpost_builder *builder,
                                            struct filpost_program **program);

/*
 All that is wrong, a line for each diagnostic.

 # Safety
 `error` comes from this library and was not freed.
 */
const char *filpost_error_message(const struct filpost_error *error);

/*
 Number of diagnostics, 1 or more.

 # Safety
 `error` comes from this library and was not freed.
 */
size_t filpost_error_count(const struct filpost_error *error);

/*
 Writes a diagnostic, counted from 0, to `diagnostic`; false where there is none.

 # Safety
 `error` comes from this library and was not freed; `diagnostic` may be written to.
 */
bool filpost_error_diagnostic(const struct filpost_error *error,
                              size_t index,
                              struct filpost_diagnostic *diagnostic);

/*
 The diagnostics as JSON, as `filpost check --format json` writes them.

 # Safety
 `error` comes from this library and was not freed.
 */
const char *filpost_error_json(const struct filpost_error *error);

/*
 True for a run that `filpost_cancel_cancel` or a callback has stopped.

 # Safety
 `error` comes from this library and was not freed.
 */
bool filpost_error_is_cancelled(const struct filpost_error *error);

/*
 Frees an error.

 # Safety
 `error` is NULL or comes from this library, and is not used again.
 */
void filpost_error_free(struct filpost_error *error);

/*
 Answers with a number, which must be finite.

 # Safety
 `reply` is that of the call that goes on.
 */
void filpost_reply_number(struct filpost_reply *reply, double number);

/*
 Answers with a text, which is copied; one that is NULL or not UTF-8 stops the run.

 # Safety
 `reply` is that of the call that goes on; `text` ends with a NUL.
 */
void filpost_reply_text(struct filpost_reply *reply, const char *text);

/*
 Says why the run must stop; the text is copied.

 # Safety
 `reply` is that of the call that goes on; `message` ends with a NUL.
 */
void filpost_reply_error(struct filpost_reply *reply, const char *message);

/*
 The bytes of the NC program, with a NUL behind them; `length`, where it is not NULL, gets
 their number.

 # Safety
 `output` is live; `length` is NULL or may be written to.
 */
const char *filpost_output_nc(const struct filpost_output *output, size_t *length);

/*
 Number of CL records that were read.

 # Safety
 `output` is live.
 */
uint64_t filpost_output_records(const struct filpost_output *output);

/*
 Number of blocks that were written.

 # Safety
 `output` is live.
 */
uint64_t filpost_output_blocks(const struct filpost_output *output);

/*
 Number of warnings.

 # Safety
 `output` is live.
 */
size_t filpost_output_warning_count(const struct filpost_output *output);

/*
 Writes a warning, counted from 0, to `warning`; false where there is none.

 # Safety
 `output` is live; `warning` may be written to.
 */
bool filpost_output_warning(const struct filpost_output *output,
                            size_t index,
                            struct filpost_diagnostic *warning);

/*
 The warnings as JSON, as `filpost check --format json` writes them.

 # Safety
 `output` is live.
 */
const char *filpost_output_warnings_json(const struct filpost_output *output);

/*
 Frees an output.

 # Safety
 `output` is NULL or live, and is not used again.
 */
void filpost_output_free(struct filpost_output *output);

/*
 Frees a program that no thread uses.

 # Safety
 `program` is NULL or live, and is not used again.
 */
void filpost_program_free(struct filpost_program *program);

/*
 Number of warnings of building.

 # Safety
 `program` is live.
 */
size_t filpost_program_warning_count(const struct filpost_program *program);

/*
 Writes a warning of building, counted from 0, to `warning`; false where there is none.

 # Safety
 `program` is live; `warning` may be written to.
 */
bool filpost_program_warning(const struct filpost_program *program,
                             size_t index,
                             struct filpost_diagnostic *warning);

/*
 Posts a CL file from memory into `output`.

 # Safety
 `program` is live, `cl` points to `cl_length` bytes, `options` is NULL or live, `output` may
 be written to.
 */
struct filpost_error *filpost_run(const struct filpost_program *program,
                                  const uint8_t *cl,
                                  size_t cl_length,
                                  const struct filpost_options *options,
                                  struct filpost_output **output);

/*
 Posts a CL file into an NC file. After an error there is no file under the name of the
 NC file; an older one stays as it was. `output` has no NC program, and may be NULL.

 # Safety
 `program` is live, `cl` and `nc` end with a NUL, `options` is NULL or live, `output` is NULL
 or may be written to.
 */
struct filpost_error *filpost_run_files(const struct filpost_program *program,
                                        const char *cl,
                                        const char *nc,
                                        const struct filpost_options *options,
                                        struct filpost_output **output);

/*
 Hands out the blocks of a CL file one by one, each with what made it. A `take` that returns
 other than 0 stops the run, which is an error that filpost_error_is_cancelled knows. The CL
 file is read once, so FIL that asks for totals of the program is refused.

 # Safety
 As filpost_run; `take` must not throw and not jump out.
 */
struct filpost_error *filpost_blocks(const struct filpost_program *program,
                                     const uint8_t *cl,
                                     size_t cl_length,
                                     const struct filpost_options *options,
                                     filpost_take_block take,
                                     void *user_data);

/*
 Compares an NC program with the CL file that it should come from. `report` is JSON, as
 `filpost verify --report json` writes it: its `verdict` is `agrees`, `partly` or `differs`.
 `tolerance` is what lengths (mm) and angles (degrees) may be off by besides their last digit.

 # Safety
 As filpost_run; `nc` points to `nc_length` bytes.
 */
struct filpost_error *filpost_verify(const struct filpost_program *program,
                                     const uint8_t *cl,
                                     size_t cl_length,
                                     const uint8_t *nc,
                                     size_t nc_length,
                                     double tolerance,
                                     const struct filpost_options *options,
                                     struct filpost_text **report);

/*
 A switch that stops runs from another thread.
 */
struct filpost_cancel *filpost_cancel_new(void);

/*
 Stops the runs that have this switch. Any thread may call it.

 # Safety
 `cancel` is NULL or live.
 */
void filpost_cancel_cancel(const struct filpost_cancel *cancel);

/*
 Frees a switch that no run has any more.

 # Safety
 `cancel` is NULL or live, and is not used again.
 */
void filpost_cancel_free(struct filpost_cancel *cancel);

/*
 The characters of a text.

 # Safety
 `text` is live.
 */
const char *filpost_text_get(const struct filpost_text *text);

/*
 Frees a text.

 # Safety
 `text` is NULL or live, and is not used again.
 */
void filpost_text_free(struct filpost_text *text);

/*
 The version of the library, `0.1.0`.
 */
const char *filpost_version(void);

/*
 Explains a code (`E0501`), a setting, a CL or FIL word, a function, a location
 (`INTCOM 1861`), a G or M code or a ready post; NULL where there is no help.

 # Safety
 `subject` ends with a NUL.
 */
struct filpost_text *filpost_explain(const char *subject);

/*
 Compares two NC programs as a control reads them. `differences` is a JSON array of
 `{"lines":[5,5],"message":"…"}`, empty when they say the same. `tolerance` is in the unit of
 the programs and in degrees.

 # Safety
 `first` and `second` point to so many bytes; `differences` may be written to.
 */
struct filpost_error *filpost_diff(const uint8_t *first,
                                   size_t first_length,
                                   const uint8_t *second,
                                   size_t second_length,
                                   double tolerance,
                                   struct filpost_text **differences);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* FILPOST_H */
