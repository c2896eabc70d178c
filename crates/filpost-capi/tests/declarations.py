"""Compares what examples/Post.cs and examples/Post.java declare with the header, without a compiler: names, number of
parameters, and for each value whether both sides mean a pointer, a size, a count or a number."""

import re
import sys
from pathlib import Path

here = Path(__file__).resolve().parent.parent

# What the sides call the same: kind by type of C#, of Java, and by type of C that is no pointer.
CSHARP = {
    "IntPtr": "pointer", "byte[]": "pointer", "out IntPtr": "pointer", "out UIntPtr": "pointer",
    "UIntPtr": "size", "ushort": "uint16", "double": "double", "void": "void",
}
JAVA = {"ADDRESS": "pointer", "JAVA_LONG": "size", "JAVA_SHORT": "uint16", "JAVA_DOUBLE": "double"}
C = {"size_t": "size", "uint16_t": "uint16", "double": "double", "void": "void",
     "filpost_function": "pointer", "filpost_free_user_data": "pointer"}


def c_kind(parameter):
    if "*" in parameter or "(" in parameter:
        return "pointer"
    words = [w for w in parameter.split() if w not in ("const", "struct", "enum")]
    return C.get(words[0], words[0])


def split(parameters):
    """Parameters at the commas that stand in no brackets."""
    flat = re.sub(r"\([^()]*\)", lambda found: found[0].replace(",", ";"), parameters)
    return [one.strip() for one in flat.split(",") if one.strip() not in ("", "void")]


def header():
    text = re.sub(r"/\*.*?\*/|^\s*#.*?$", "", (here / "include/filpost.h").read_text(), flags=re.S | re.M)
    declared = re.compile(r"([\w\s]+?[\s*]+)(filpost_\w+)\s*\(((?:[^()]|\([^()]*\))*)\)\s*;")
    return {
        name: [c_kind(f"{returned.strip()} ")] + [c_kind(one) for one in split(parameters)]
        for returned, name, parameters in declared.findall(text)
    }


def csharp():
    text = re.sub(r"//.*", "", (here / "examples/Post.cs").read_text())
    delegates = set(re.findall(r"delegate \w+ (\w+)\(", text))
    imported = re.compile(r"\[DllImport\(Library\)\]\s*public static extern (\w+) (\w+)\(([^)]*)\);")
    for returned, name, parameters in imported.findall(text):
        types = [" ".join(one.split()[:-1]) for one in split(parameters)]
        yield name, [CSHARP[returned]] + ["pointer" if t in delegates else CSHARP[t] for t in types]


def java():
    text = re.sub(r"//.*", "", (here / "examples/Post.java").read_text())
    for form, name, layouts in re.findall(r'= (returns|runs)\(\s*"(filpost_\w+)"((?:, \w+)*)\);', text):
        kinds = [JAVA.get(one, one) for one in layouts.replace(",", " ").split()]
        yield name, kinds if form == "returns" else ["void"] + kinds


declared = header()
for example, functions in [("Post.cs", list(csharp())), ("Post.java", list(java()))]:
    wrong = [f"{name}: {kinds}, C {declared.get(name)}" for name, kinds in functions if declared.get(name) != kinds]
    if wrong or not functions:
        sys.exit(f"examples/{example} and include/filpost.h differ:\n" + "\n".join(wrong))
    print(f"{len(functions)} functions of examples/{example} are those of the header")
