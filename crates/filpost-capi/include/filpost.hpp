/*
 * filpost for C++17: handles that free themselves, errors as exceptions.
 * A thin layer over filpost.h; header only.
 */
#ifndef FILPOST_HPP
#define FILPOST_HPP

#include <filpost.h>

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace filpost {

/// An error or a warning, copied out of the library.
struct Diagnostic {
    std::string code, title, message, file, hint;
    bool error = true;
    /// From 1; 0 without a place.
    unsigned line = 0, column = 0;

    explicit Diagnostic(const filpost_diagnostic &of)
        : code(of.code), title(of.title), message(of.message), file(of.file ? of.file : ""),
          hint(of.hint), error(of.severity == FILPOST_SEVERITY_ERROR), line(of.line),
          column(of.column) {}
};

/// What the library refuses. Of an exception that a function of yours has thrown, `cause` is
/// that exception.
class Error : public std::runtime_error {
  public:
    std::vector<Diagnostic> diagnostics;
    std::string json;
    bool cancelled = false;
    std::exception_ptr cause;

    explicit Error(const filpost_error *error)
        : std::runtime_error(filpost_error_message(error)), json(filpost_error_json(error)),
          cancelled(filpost_error_is_cancelled(error)) {
        filpost_diagnostic one;
        for (size_t i = 0; filpost_error_diagnostic(error, i, &one); ++i) {
            diagnostics.emplace_back(one);
        }
    }
    /// Code of the first diagnostic.
    const std::string &code() const { return diagnostics.front().code; }
};

namespace detail {

template <auto Free> struct Freed {
    template <typename T> void operator()(T *handle) const { Free(handle); }
};
template <typename T, auto Free> using Handle = std::unique_ptr<T, Freed<Free>>;

/// What a function of the host has thrown last in this thread: C must not be unwound.
inline std::exception_ptr &thrown() {
    thread_local std::exception_ptr last;
    return last;
}

inline void check(filpost_error *error) {
    auto cause = std::exchange(thrown(), nullptr);
    if (error == nullptr) {
        return;
    }
    Handle<filpost_error, filpost_error_free> owned(error);
    Error told(owned.get());
    told.cause = cause;
    throw told;
}

inline const uint8_t *bytes(std::string_view text) {
    return reinterpret_cast<const uint8_t *>(text.data());
}

} // namespace detail

/// A number, a text, or EMPTY.
using Value = std::variant<std::monostate, double, std::string>;

/// A function for FIL; threads that share the program call it at the same time. What it throws
/// stops the run.
using Function = std::function<Value(const std::vector<Value> &)>;

/// A switch that stops runs from another thread.
class Cancel {
    detail::Handle<filpost_cancel, filpost_cancel_free> handle{filpost_cancel_new()};

  public:
    void cancel() const { filpost_cancel_cancel(handle.get()); }
    const filpost_cancel *get() const { return handle.get(); }
};

/// The options of a run; empty ones are as without.
struct Options {
    std::string cl_name, dialect, units;
    const Cancel *cancel = nullptr;

    filpost_options as_c() const {
        auto text = [](const std::string &of) { return of.empty() ? nullptr : of.c_str(); };
        return {text(cl_name), text(dialect), text(units), cancel ? cancel->get() : nullptr};
    }
};

/// An NC program and what its run has to tell.
class Output {
    detail::Handle<filpost_output, filpost_output_free> handle;

  public:
    explicit Output(filpost_output *owned) : handle(owned) {}
    /// The NC program; it lives as long as this output.
    std::string_view nc() const {
        size_t length = 0;
        const char *text = filpost_output_nc(handle.get(), &length);
        return {text, length};
    }
    uint64_t records() const { return filpost_output_records(handle.get()); }
    uint64_t blocks() const { return filpost_output_blocks(handle.get()); }
    std::vector<Diagnostic> warnings() const {
        std::vector<Diagnostic> all;
        filpost_diagnostic one;
        for (size_t i = 0; filpost_output_warning(handle.get(), i, &one); ++i) {
            all.emplace_back(one);
        }
        return all;
    }
};

/// A machine with its compiled FIL. Any number of threads may use it at the same time.
class Program {
    detail::Handle<filpost_program, filpost_program_free> handle;

    std::string text_of(filpost_text *owned) const {
        detail::Handle<filpost_text, filpost_text_free> text(owned);
        return filpost_text_get(text.get());
    }

  public:
    explicit Program(filpost_program *owned) : handle(owned) {}

    Output run(std::string_view cl, const Options &options = {}) const {
        filpost_output *output = nullptr;
        auto given = options.as_c();
        detail::check(
            filpost_run(handle.get(), detail::bytes(cl), cl.size(), &given, &output));
        return Output(output);
    }

    /// After an error there is no file under the name of the NC file.
    void run_files(const std::string &cl, const std::string &nc,
                   const Options &options = {}) const {
        auto given = options.as_c();
        detail::check(filpost_run_files(handle.get(), cl.c_str(), nc.c_str(), &given, nullptr));
    }

    /// Hands out blocks one by one; a `take` that returns false stops the run, and what it
    /// throws comes out of here.
    void blocks(std::string_view cl, const std::function<bool(const filpost_block &)> &take,
                const Options &options = {}) const {
        struct Taker {
            const std::function<bool(const filpost_block &)> &take;
            std::exception_ptr thrown;
            bool stopped = false;
        } taker{take, nullptr};
        auto given = options.as_c();
        auto call = [](const filpost_block *block, void *data) noexcept -> int32_t {
            auto &taker = *static_cast<Taker *>(data);
            try {
                taker.stopped = !taker.take(*block);
            } catch (...) {
                taker.thrown = std::current_exception();
            }
            return taker.stopped || taker.thrown ? 1 : 0;
        };
        auto *error =
            filpost_blocks(handle.get(), detail::bytes(cl), cl.size(), &given, call, &taker);
        if (taker.thrown || taker.stopped) {
            filpost_error_free(error);
            if (taker.thrown) {
                std::rethrow_exception(taker.thrown);
            }
            return;
        }
        detail::check(error);
    }

    /// JSON of a check of an NC program against its CL file.
    std::string verify(std::string_view cl, std::string_view nc, double tolerance = 0,
                       const Options &options = {}) const {
        filpost_text *report = nullptr;
        auto given = options.as_c();
        detail::check(filpost_verify(handle.get(), detail::bytes(cl), cl.size(),
                                     detail::bytes(nc), nc.size(), tolerance, &given, &report));
        return text_of(report);
    }
};

/// Collects what a program is made of.
class Builder {
    detail::Handle<filpost_builder, filpost_builder_free> handle{filpost_builder_new()};

    static int32_t call(void *data, const filpost_value *arguments, size_t count,
                        filpost_reply *reply) noexcept {
        try {
            std::vector<Value> given;
            for (size_t i = 0; i < count; ++i) {
                switch (arguments[i].kind) {
                case FILPOST_VALUE_KIND_NUMBER: given.emplace_back(arguments[i].number); break;
                case FILPOST_VALUE_KIND_TEXT:
                    given.emplace_back(std::string(arguments[i].text));
                    break;
                default: given.emplace_back(std::monostate{});
                }
            }
            auto answer = (*static_cast<const Function *>(data))(given);
            if (auto *number = std::get_if<double>(&answer)) {
                filpost_reply_number(reply, *number);
            } else if (auto *text = std::get_if<std::string>(&answer)) {
                filpost_reply_text(reply, text->c_str());
            }
            return 0;
        } catch (const std::exception &thrown) {
            detail::thrown() = std::current_exception();
            filpost_reply_error(reply, thrown.what());
        } catch (...) {
            detail::thrown() = std::current_exception();
            filpost_reply_error(reply, "the function has thrown");
        }
        return 1;
    }

  public:
    Builder &ready(const std::string &name) {
        detail::check(filpost_builder_ready(handle.get(), name.c_str()));
        return *this;
    }
    /// The post in a folder: its machine.toml and, where there is one, post.fil.
    Builder &folder(const std::string &path) {
        detail::check(filpost_builder_folder(handle.get(), path.c_str()));
        return *this;
    }
    /// `system`, or a moment such as `2026-01-31T12:00:00`.
    Builder &clock(const std::string &clock) {
        detail::check(filpost_builder_clock(handle.get(), clock.c_str()));
        return *this;
    }
    Builder &machine(const std::string &name, const std::string &text) {
        detail::check(filpost_builder_machine(handle.get(), name.c_str(), text.c_str()));
        return *this;
    }
    Builder &option_file(const std::string &name, const std::string &text) {
        detail::check(filpost_builder_option_file(handle.get(), name.c_str(), text.c_str()));
        return *this;
    }
    Builder &over(const std::string &name, const std::string &text) {
        detail::check(filpost_builder_over(handle.get(), name.c_str(), text.c_str()));
        return *this;
    }
    Builder &option(const std::string &name, const std::string &value) {
        detail::check(filpost_builder_option(handle.get(), name.c_str(), value.c_str()));
        return *this;
    }
    Builder &set(const std::string &setting) {
        detail::check(filpost_builder_set(handle.get(), setting.c_str()));
        return *this;
    }
    Builder &fil(const std::string &name, const std::string &text) {
        detail::check(filpost_builder_fil(handle.get(), name.c_str(), text.c_str()));
        return *this;
    }
    Builder &limit(const std::string &name, uint64_t most) {
        detail::check(filpost_builder_limit(handle.get(), name.c_str(), most));
        return *this;
    }
    Builder &allow(const std::string &code) {
        detail::check(filpost_builder_allow(handle.get(), code.c_str()));
        return *this;
    }
    Builder &function(const std::string &name, uint16_t arguments, Function body) {
        auto data = std::make_unique<Function>(std::move(body));
        detail::check(filpost_builder_function(
            handle.get(), name.c_str(), arguments, call, data.get(),
            [](void *data) { delete static_cast<Function *>(data); }));
        data.release();
        return *this;
    }
    Program build() {
        filpost_program *program = nullptr;
        detail::check(filpost_builder_build(handle.release(), &program));
        return Program(program);
    }
};

/// What a code, a setting, a word, a function, a G or M code or a ready post means; nothing
/// where there is no help.
inline std::optional<std::string> explain(const std::string &subject) {
    detail::Handle<filpost_text, filpost_text_free> text(filpost_explain(subject.c_str()));
    if (!text.get()) {
        return std::nullopt;
    }
    return filpost_text_get(text.get());
}

} // namespace filpost

#endif
