// The same as post.c with the C++ wrapper.
#include <filpost.hpp>
#include <iostream>

int main() try {
    auto tool_life = [](const std::vector<filpost::Value> &given) -> filpost::Value {
        return std::get<double>(given.at(0)) == 3 ? 8.0 : 60.0;
    };
    auto program = filpost::Builder()
                       .ready("fanuc-mill")
                       .fil("life.fil", "CIMFIL/ON,LOADTL\nLIFE=TLIFEF(POSTF(7,4))\n"
                                        "IF(LIFE.LT.10) STOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")
                       .function("TLIFEF", 1, tool_life)
                       .build();
    std::cout << program
                     .run("UNITS / MM\nLOADTL / 3\nFEDRAT / 300, MMPM\nGOTO / 40, 0, 5\nFINI\n")
                     .nc();
} catch (const filpost::Error &error) {
    std::cerr << error.what() << '\n';
    return 1;
}
