// The C++ wrapper: exceptions cross FIL, threads share a program, handles free themselves.
#include <filpost.hpp>

#include <cstdio>
#include <cstdlib>
#include <thread>

#define MUST(what)                                                                                 \
    do {                                                                                           \
        if (!(what)) {                                                                             \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #what);                        \
            std::exit(1);                                                                          \
        }                                                                                          \
    } while (0)

namespace {

const std::string CL = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\n"
                       "GOTO / 1, 2, 3\nFINI\n";
const std::string FIL = "CIMFIL/ON,LOADTL\nPOSTN/OUT,G,0,Z,SAFEZF(POSTF(7,4))\n"
                        "NAME=TNAMEF('T',POSTF(4))\nPPRINT/NAME\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";

struct Drawer : std::runtime_error {
    using std::runtime_error::runtime_error;
};

filpost::Program program() {
    auto height = [](const std::vector<filpost::Value> &given) -> filpost::Value {
        double tool = std::get<double>(given.at(0));
        if (tool > 90) {
            throw Drawer("this tool is in no drawer");
        }
        return 100 + tool;
    };
    auto name = [](const std::vector<filpost::Value> &given) -> filpost::Value {
        MUST(std::get<std::string>(given.at(0)) == "T");
        MUST(std::holds_alternative<std::monostate>(given.at(1)));
        return std::string("END MILL");
    };
    return filpost::Builder()
        .ready("fanuc-mill")
        .option("style", "plain")
        .set("rapid.split=0")
        .fil("raise.fil", FIL)
        .limit("fuel", 1000)
        .function("SAFEZF", 1, height)
        .function("TNAMEF", 2, name)
        .build();
}

} // namespace

int main() {
    auto post = program();
    auto output = post.run(CL);
    MUST(output.nc().find("Z103.") != std::string_view::npos);
    MUST(output.nc().find("(END MILL)") != std::string_view::npos);
    MUST(output.records() == 6 && output.warnings().empty());

    try {
        post.run("UNITS / MM\nLOADTL / 99\nFINI\n");
        MUST(!"refused");
    } catch (const filpost::Error &error) {
        MUST(error.diagnostics.at(0).file == "raise.fil" && error.diagnostics.at(0).line == 2);
        MUST(error.cause);
        try {
            std::rethrow_exception(error.cause);
        } catch (const Drawer &) {
        }
    }
    try {
        filpost::Builder().ready("no-such-mill").build();
        MUST(!"refused");
    } catch (const filpost::Error &error) {
        MUST(error.code()[0] == 'E' && !error.cause);
    }

    auto of_a_folder = filpost::Builder().folder("tests/folder").clock("2026-01-31T12:00:00").build();
    MUST(of_a_folder.run(CL).nc().find("(TOOL 3 OF 2026)") != std::string_view::npos);
    MUST(filpost::explain("G83").value().find("G83") == 0 && !filpost::explain("QWXYZ9"));

    std::string text;
    post.blocks(CL, [&](const filpost_block &block) {
        text += std::string(block.text) + "\n";
        return true;
    });
    MUST(text == output.nc());
    int count = 0;
    post.blocks(CL, [&](const filpost_block &) { return ++count < 2; });
    MUST(count == 2);
    try {
        post.blocks(CL, [](const filpost_block &) -> bool { throw Drawer("full"); });
        MUST(!"thrown");
    } catch (const Drawer &) {
    }

    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] { MUST(post.run(CL).nc() == output.nc()); });
    }
    for (auto &thread : threads) {
        thread.join();
    }

    filpost::Cancel cancel;
    cancel.cancel();
    filpost::Options options;
    options.cancel = &cancel;
    try {
        post.run(CL, options);
        MUST(!"cancelled");
    } catch (const filpost::Error &error) {
        MUST(error.cancelled);
    }
    auto mill = filpost::Builder().ready("fanuc-mill").option("style", "plain").build();
    MUST(mill.verify(CL, mill.run(CL).nc()).find("\"agrees\"") != std::string::npos);
    std::puts("C++: all as it must be");
}
