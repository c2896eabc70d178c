// The same as post.c from C#, by platform invoke. Copy libfilpost.so (filpost.dll) beside it.
using System;
using System.Runtime.InteropServices;
using System.Text;

static class Native
{
    const string Library = "filpost";

    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
    public delegate int Function(IntPtr userData, IntPtr arguments, UIntPtr count, IntPtr reply);

    // filpost_value: an int, padded to 8 bytes, a double, a pointer.
    [StructLayout(LayoutKind.Sequential)]
    public struct Value
    {
        public int Kind; // 0 EMPTY, 1 number, 2 text
        public double Number;
        public IntPtr Text;
    }

    [DllImport(Library)] public static extern IntPtr filpost_builder_new();
    [DllImport(Library)] public static extern IntPtr filpost_builder_ready(IntPtr builder, byte[] name);
    [DllImport(Library)] public static extern IntPtr filpost_builder_fil(IntPtr builder, byte[] name, byte[] text);
    [DllImport(Library)] public static extern IntPtr filpost_builder_function(IntPtr builder, byte[] name,
        ushort arguments, Function function, IntPtr userData, IntPtr freeUserData);
    [DllImport(Library)] public static extern IntPtr filpost_builder_build(IntPtr builder, out IntPtr program);
    [DllImport(Library)] public static extern IntPtr filpost_run(IntPtr program, byte[] cl, UIntPtr length,
        IntPtr options, out IntPtr output);
    [DllImport(Library)] public static extern IntPtr filpost_output_nc(IntPtr output, out UIntPtr length);
    [DllImport(Library)] public static extern void filpost_output_free(IntPtr output);
    [DllImport(Library)] public static extern void filpost_program_free(IntPtr program);
    [DllImport(Library)] public static extern void filpost_reply_number(IntPtr reply, double number);
    [DllImport(Library)] public static extern IntPtr filpost_error_message(IntPtr error);
    [DllImport(Library)] public static extern void filpost_error_free(IntPtr error);

    // Texts go in as UTF-8 with a NUL behind them.
    public static byte[] Utf8(string text) => Encoding.UTF8.GetBytes(text + "\0");

    public static void Check(IntPtr error)
    {
        if (error == IntPtr.Zero) return;
        string message = Marshal.PtrToStringUTF8(filpost_error_message(error));
        filpost_error_free(error);
        throw new InvalidOperationException(message);
    }
}

static class Post
{
    static int ToolLife(IntPtr userData, IntPtr arguments, UIntPtr count, IntPtr reply)
    {
        var tool = Marshal.PtrToStructure<Native.Value>(arguments);
        Native.filpost_reply_number(reply, tool.Number == 3 ? 8 : 60);
        return 0; // an exception must not leave this function: catch it and return 1
    }

    static void Main()
    {
        // The library keeps the function: so must the program, or it is collected.
        Native.Function toolLife = ToolLife;
        IntPtr builder = Native.filpost_builder_new();
        Native.Check(Native.filpost_builder_ready(builder, Native.Utf8("fanuc-mill")));
        Native.Check(Native.filpost_builder_fil(builder, Native.Utf8("life.fil"), Native.Utf8(
            "CIMFIL/ON,LOADTL\nLIFE=TLIFEF(POSTF(7,4))\nIF(LIFE.LT.10) STOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")));
        Native.Check(Native.filpost_builder_function(builder, Native.Utf8("TLIFEF"), 1, toolLife,
            IntPtr.Zero, IntPtr.Zero));
        Native.Check(Native.filpost_builder_build(builder, out IntPtr program));
        byte[] cl = Encoding.UTF8.GetBytes(
            "UNITS / MM\nLOADTL / 3\nFEDRAT / 300, MMPM\nGOTO / 40, 0, 5\nFINI\n");
        Native.Check(Native.filpost_run(program, cl, (UIntPtr)cl.Length, IntPtr.Zero, out IntPtr output));
        IntPtr nc = Native.filpost_output_nc(output, out UIntPtr length);
        byte[] bytes = new byte[(int)length];
        Marshal.Copy(nc, bytes, 0, bytes.Length);
        Console.Write(Encoding.UTF8.GetString(bytes));
        Native.filpost_output_free(output);
        Native.filpost_program_free(program);
        GC.KeepAlive(toolLife);
    }
}
