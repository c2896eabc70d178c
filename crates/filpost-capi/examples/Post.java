// The same as post.c from Java 22 or later, by java.lang.foreign. The library (libfilpost.so, filpost.dll)
// must be where the system looks for libraries:
// LD_LIBRARY_PATH=/usr/local/lib java --enable-native-access=ALL-UNNAMED Post.java
import static java.lang.foreign.ValueLayout.ADDRESS;
import static java.lang.foreign.ValueLayout.JAVA_BYTE;
import static java.lang.foreign.ValueLayout.JAVA_DOUBLE;
import static java.lang.foreign.ValueLayout.JAVA_INT;
import static java.lang.foreign.ValueLayout.JAVA_LONG;
import static java.lang.foreign.ValueLayout.JAVA_SHORT;

import java.lang.foreign.Arena;
import java.lang.foreign.FunctionDescriptor;
import java.lang.foreign.Linker;
import java.lang.foreign.MemoryLayout;
import java.lang.foreign.MemorySegment;
import java.lang.foreign.StructLayout;
import java.lang.foreign.SymbolLookup;
import java.lang.invoke.MethodHandle;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.MethodType;
import java.nio.charset.StandardCharsets;

/** The functions of filpost.h that the example needs. */
final class Native {
    static final Linker LINKER = Linker.nativeLinker();
    static final SymbolLookup LIBRARY =
            SymbolLookup.libraryLookup(System.mapLibraryName("filpost"), Arena.global());

    /** filpost_value: an int, padded to 8 bytes, a double, a pointer. */
    static final StructLayout VALUE = MemoryLayout.structLayout(
            JAVA_INT, // 0 EMPTY, 1 number, 2 text
            MemoryLayout.paddingLayout(4), JAVA_DOUBLE, ADDRESS);
    static final long KIND = 0, NUMBER = 8;

    /** filpost_function: user data, arguments, their count, the reply. */
    static final FunctionDescriptor FUNCTION = FunctionDescriptor.of(
            JAVA_INT, ADDRESS, ADDRESS.withTargetLayout(VALUE), JAVA_LONG, ADDRESS);

    static final MethodHandle BUILDER_NEW = returns("filpost_builder_new", ADDRESS);
    static final MethodHandle BUILDER_READY = returns("filpost_builder_ready", ADDRESS, ADDRESS, ADDRESS);
    static final MethodHandle BUILDER_FIL = returns("filpost_builder_fil", ADDRESS, ADDRESS, ADDRESS, ADDRESS);
    static final MethodHandle BUILDER_FUNCTION = returns(
            "filpost_builder_function", ADDRESS, ADDRESS, ADDRESS, JAVA_SHORT, ADDRESS, ADDRESS, ADDRESS);
    static final MethodHandle BUILDER_BUILD = returns("filpost_builder_build", ADDRESS, ADDRESS, ADDRESS);
    static final MethodHandle RUN = returns(
            "filpost_run", ADDRESS, ADDRESS, ADDRESS, JAVA_LONG, ADDRESS, ADDRESS);
    static final MethodHandle OUTPUT_NC = returns("filpost_output_nc", ADDRESS, ADDRESS, ADDRESS);
    static final MethodHandle OUTPUT_FREE = runs("filpost_output_free", ADDRESS);
    static final MethodHandle PROGRAM_FREE = runs("filpost_program_free", ADDRESS);
    static final MethodHandle REPLY_NUMBER = runs("filpost_reply_number", ADDRESS, JAVA_DOUBLE);
    static final MethodHandle REPLY_ERROR = runs("filpost_reply_error", ADDRESS, ADDRESS);
    static final MethodHandle ERROR_MESSAGE = returns("filpost_error_message", ADDRESS, ADDRESS);
    static final MethodHandle ERROR_FREE = runs("filpost_error_free", ADDRESS);

    private static MethodHandle returns(String name, MemoryLayout result, MemoryLayout... arguments) {
        return LINKER.downcallHandle(
                LIBRARY.find(name).orElseThrow(), FunctionDescriptor.of(result, arguments));
    }

    private static MethodHandle runs(String name, MemoryLayout... arguments) {
        return LINKER.downcallHandle(
                LIBRARY.find(name).orElseThrow(), FunctionDescriptor.ofVoid(arguments));
    }

    /** Throws the message of an error, and frees it; NULL is none. */
    static void check(MemorySegment error) throws Throwable {
        if (error.equals(MemorySegment.NULL)) return;
        var message = (MemorySegment) ERROR_MESSAGE.invokeExact(error);
        var text = message.reinterpret(Long.MAX_VALUE).getString(0);
        ERROR_FREE.invokeExact(error);
        throw new IllegalStateException(text);
    }
}

public final class Post {
    /** The function TLIFEF of the script. An exception must not leave it: that ends the virtual machine. */
    static int toolLife(MemorySegment userData, MemorySegment arguments, long count, MemorySegment reply) {
        try (var arena = Arena.ofConfined()) {
            if (arguments.get(JAVA_INT, Native.KIND) != 1) {
                Native.REPLY_ERROR.invokeExact(reply, arena.allocateFrom("a tool number is needed"));
                return 1;
            }
            double tool = arguments.get(JAVA_DOUBLE, Native.NUMBER);
            Native.REPLY_NUMBER.invokeExact(reply, tool == 3 ? 8.0 : 60.0);
            return 0;
        } catch (Throwable failure) {
            return 1;
        }
    }

    public static void main(String[] arguments) throws Throwable {
        var fil = "CIMFIL/ON,LOADTL\nLIFE=TLIFEF(POSTF(7,4))\nIF(LIFE.LT.10) STOP\n"
                + "DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
        var cl = "UNITS / MM\nLOADTL / 3\nFEDRAT / 300, MMPM\nGOTO / 40, 0, 5\nFINI\n";
        // The arena keeps the function alive: the program must not outlive it.
        try (var arena = Arena.ofConfined()) {
            var method = MethodHandles.lookup().findStatic(Post.class, "toolLife", MethodType.methodType(
                    int.class, MemorySegment.class, MemorySegment.class, long.class, MemorySegment.class));
            var toolLife = Native.LINKER.upcallStub(method, Native.FUNCTION, arena);
            var none = MemorySegment.NULL;
            var builder = (MemorySegment) Native.BUILDER_NEW.invokeExact();
            Native.check((MemorySegment) Native.BUILDER_READY.invokeExact(
                    builder, arena.allocateFrom("fanuc-mill")));
            Native.check((MemorySegment) Native.BUILDER_FIL.invokeExact(
                    builder, arena.allocateFrom("life.fil"), arena.allocateFrom(fil)));
            Native.check((MemorySegment) Native.BUILDER_FUNCTION.invokeExact(
                    builder, arena.allocateFrom("TLIFEF"), (short) 1, toolLife, none, none));

            var handle = arena.allocate(ADDRESS);
            Native.check((MemorySegment) Native.BUILDER_BUILD.invokeExact(builder, handle));
            var program = handle.get(ADDRESS, 0);

            byte[] bytes = cl.getBytes(StandardCharsets.UTF_8);
            Native.check((MemorySegment) Native.RUN.invokeExact(
                    program, arena.allocateFrom(JAVA_BYTE, bytes), (long) bytes.length, none, handle));
            var output = handle.get(ADDRESS, 0);

            var length = arena.allocate(JAVA_LONG);
            var nc = (MemorySegment) Native.OUTPUT_NC.invokeExact(output, length);
            System.out.write(nc.reinterpret(length.get(JAVA_LONG, 0)).toArray(JAVA_BYTE));
            System.out.flush();
            Native.OUTPUT_FREE.invokeExact(output);
            Native.PROGRAM_FREE.invokeExact(program);
        }
    }
}
