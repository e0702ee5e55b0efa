// SPDX-License-Identifier: MIT
// Tactus in C#: the C API (tactus.h) by P/Invoke, in one file. For .NET, Mono and Unity; compile it with -unsafe (Unity: "Allow 'unsafe' code").
// The library is libtactus.so, libtactus.dll or libtactus.dylib, next to the program or in a folder of the system; in Unity in Assets/Plugins.
//
//     using (var graph = Graph.Load ("dry_wood.json"))
//     using (var run = new Run (graph))
//     {
//         run.PushedDevice ("stylus");
//         run.Open();
//         var reading = Reading.At (x, y, z);
//         run.Push ("stylus", ref reading);   // what your device measured
//         run.Tick();
//         run.Take ("stylus", ref effort);    // what your device should apply
//     }
//
// Units are SI. Axes are right-handed: x right, y away from the person, z up. Functions have the threads of tactus.h. A failure is a
// TactusException with the messages of the library; a call at a wrong time is an InvalidOperationException.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Tactus
{
    /// <summary>An error or warning of the library.</summary>
    public struct Message
    {
        public bool IsError;
        public string Id, Where, Text, Remedy, File;
        public int Line, Column;   // from 1; 0 if unknown

        public override string ToString()
        {
            return (IsError ? "error: " : "warning: ") + (Where.Length > 0 ? Where + ": " : "") + Text + (Remedy.Length > 0 ? "\n    " + Remedy : "")
                   + " [" + Id + "]";
        }
    }

    public sealed class TactusException : Exception
    {
        public readonly IReadOnlyList<Message> Messages;

        internal TactusException (List<Message> messages) : base (messages.Count > 0 ? messages[messages.Count - 1].ToString() : "Tactus gave no reason")
        {
            Messages = messages;
        }
    }

    /// <summary>What a device measured: tactus_reading.</summary>
    [StructLayout (LayoutKind.Sequential)]
    public unsafe struct Reading
    {
        public uint Size;
        public int Valid;                    // 0: nothing to report, and the force is held at zero
        public fixed double Position[3];     // m
        public fixed double Rotation[3];     // rotation vector, rad
        public double Pressure;              // N
        public double Age;                   // s since the device took this reading
        public uint Buttons;                 // bit i: button i is down
        public uint AxisCount, SignalCount;
        public fixed double Axes[Native.channels];
        public fixed double Signals[Native.channels];

        /// <summary>A valid reading of a tool at this place, in m.</summary>
        public static Reading At (double x, double y, double z)
        {
            var r = new Reading { Size = (uint)sizeof (Reading), Valid = 1 };
            r.Position[0] = x;
            r.Position[1] = y;
            r.Position[2] = z;
            return r;
        }
    }

    /// <summary>What a device should apply, after the guard: tactus_effort.</summary>
    [StructLayout (LayoutKind.Sequential)]
    public unsafe struct Effort
    {
        public uint Size;
        public fixed double Force[3];    // on the tool, N
        public fixed double Torque[3];   // on the tool, N m
        public uint AxisCount, SignalCount;
        public fixed double Axes[Native.channels];
        public fixed double Signals[Native.channels];
        public double Brake;             // N s/m
        public double MaxSignal;
        public uint IsWithheld;

        public static Effort None() { return new Effort { Size = (uint)sizeof (Effort) }; }
        public double X { get { fixed (double* f = Force) return f[0]; } }
        public double Y { get { fixed (double* f = Force) return f[1]; } }
        public double Z { get { fixed (double* f = Force) return f[2]; } }
    }

    /// <summary>Where a tool is on the ticks of a step (docs/steps.md), and the effort that Take returns after a step.</summary>
    public enum Between { Hold = 0, Linear = 1, ByVelocity = 2 }
    public enum StepEffort { LastTick = 0, Mean = 1 }

    /// <summary>Why a guard withholds an effort. The last four are latched: they end with Rearm(), or with a state from before.</summary>
    public enum Stop { None = 0, NotFinite = 1, Stale = 2, Starved = 3, Released = 4, Halted = 5, Speed = 6, Impulse = 7, Energy = 8, Emergency = 9 }

    /// <summary>The guard of a role after the latest tick: tactus_guard.</summary>
    [StructLayout (LayoutKind.Sequential)]
    public struct Guard
    {
        public uint Size;
        public Stop Stop;                       // now
        public int IsLatched, IsClipping;
        public Stop Latest;                     // also if it has ended
        public double Value, Limit, Window;     // of the latest stop: SI, SI, s
        public ulong Stops;
    }

    public enum Phase { Idle = 0, Running = 1, Halting = 2, Over = 3 }

    /// <summary>tactus_status</summary>
    [StructLayout (LayoutKind.Sequential)]
    public struct Status
    {
        public uint Size;
        public Phase Phase;
        public ulong Ticks, LateTicks;
        public double Force, PeakForce;   // N
        public int IsEmergency;
    }

    public static class Library
    {
        public static string Version { get { return Native.Text (Native.tactus_version()); } }

        /// <summary>The datasheets of all nodes, as JSON.</summary>
        public static string NodesJson() { return Native.Taken (Native.tactus_nodes_json()); }
    }

    /// <summary>A graph with its undo history. [main thread]</summary>
    public sealed class Graph : IDisposable
    {
        internal readonly GraphHandle Handle;

        Graph (GraphHandle handle, MessageList messages)
        {
            if (handle.IsInvalid) throw messages.Failure();
            Handle = handle;
        }

        public static Graph Create (string name, double rateHz)
        {
            using (var m = new MessageList()) return new Graph (Native.tactus_graph_create (Native.Utf8 (name), rateHz, m.Pointer), m);
        }

        /// <summary>Reads a graph file and the files that it includes.</summary>
        public static Graph Load (string path)
        {
            using (var m = new MessageList()) return new Graph (Native.tactus_graph_load (Native.Utf8 (path), m.Pointer), m);
        }

        /// <summary>Reads a graph from text. Files that it names are relative to the folder; null: the current one.</summary>
        public static Graph Parse (string text, string folder = null)
        {
            var bytes = Native.Utf8 (text);
            using (var m = new MessageList())
                return new Graph (Native.tactus_graph_parse (bytes, (UIntPtr)(bytes.Length - 1), Native.Utf8 (folder), m.Pointer), m);
        }

        public double RateHz { get { return Native.tactus_graph_rate (Handle); } }
        public string Text { get { return Native.Taken (Native.tactus_graph_text (Handle)); } }

        public void Save (string path)
        {
            using (var m = new MessageList()) m.Check (Native.tactus_graph_save (Handle, Native.Utf8 (path), m.Pointer));
        }

        // Edits: values are JSON, as in a graph file. `patch` is "" for the graph itself, or the name of a subgraph.

        public void AddNode (string name, string type, string patch = "")
        {
            using (var m = new MessageList())
                m.Check (Native.tactus_graph_add_node (Handle, Native.Utf8 (patch), Native.Utf8 (name), Native.Utf8 (type), m.Pointer));
        }

        public void SetParam (string node, string param, string value, string patch = "")
        {
            using (var m = new MessageList())
                m.Check (Native.tactus_graph_set_param (Handle, Native.Utf8 (patch), Native.Utf8 (node), Native.Utf8 (param), Native.Utf8 (value), m.Pointer));
        }

        public void AddWire (string wire, string patch = "")
        {
            using (var m = new MessageList()) m.Check (Native.tactus_graph_add_wire (Handle, Native.Utf8 (patch), Native.Utf8 (wire), m.Pointer));
        }

        public bool Undo() { return Native.tactus_graph_undo (Handle) != 0; }
        public bool Redo() { return Native.tactus_graph_redo (Handle) != 0; }

        public void Dispose() { Handle.Dispose(); }
    }

    /// <summary>What a run is made with. Everything may be left out.</summary>
    public sealed class RunOptions
    {
        public double RateHz;              // 0: that of the graph
        public string[] Feeds, Records, Sets;
        public string Log;                 // a file for the log of all inputs
    }

    /// <summary>A graph that is played. Dispose() brings all forces to zero, and waits for it. [main thread, unless a function says otherwise]</summary>
    public sealed class Run : IDisposable
    {
        readonly RunHandle handle;
        readonly Dictionary<string, byte[]> names = new Dictionary<string, byte[]>();   // of roles, so that Push and Take allocate nothing

        public Run (Graph graph, RunOptions options = null)
        {
            options = options ?? new RunOptions();
            using (var m = new MessageList())
            using (var feeds = new Texts (options.Feeds))
            using (var records = new Texts (options.Records))
            using (var sets = new Texts (options.Sets))
            using (var log = new Texts (options.Log == null ? null : new[] { options.Log }))
            {
                var native = new Native.RunOptions {
                    rate_hz = options.RateHz, feeds = feeds.Pointer, feed_count = feeds.Count, records = records.Pointer, record_count = records.Count,
                    sets = sets.Pointer, set_count = sets.Count, log = log.First
                };
                native.size = (uint)Marshal.SizeOf (native);
                handle = Native.tactus_run_create (graph.Handle, ref native, m.Pointer);
                if (handle.IsInvalid) throw m.Failure();
            }
            foreach (var role in Roles) names[role] = Native.Utf8 (role);
        }

        public double RateHz { get { return Native.tactus_run_rate (handle); } }

        public string[] Roles
        {
            get
            {
                var all = new string[(int)Native.tactus_run_role_count (handle)];
                for (int i = 0; i < all.Length; ++i) all[i] = Native.Text (Native.tactus_run_role (handle, (UIntPtr)i));
                return all;
            }
        }

        /// <summary>The names of the recorded components, such as "motor.force.x".</summary>
        public string[] RecordNames
        {
            get
            {
                var all = new string[(int)Native.tactus_run_record_count (handle)];
                for (int i = 0; i < all.Length; ++i) all[i] = Native.Text (Native.tactus_run_record_name (handle, (UIntPtr)i));
                return all;
            }
        }

        /// <summary>The device of a role, as for the option --device: "sim", "trace:FILE.csv", "gesture:NAME", "FILE.json".</summary>
        public void Device (string role, string device)
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_device (handle, Native.Utf8 (role), Native.Utf8 (device), m.Pointer));
        }

        /// <summary>Your own device: you push readings and take efforts. `guard` is JSON with its limits: {"max_force": "3 N"}. `between` and
        /// `stepEffort` are the rules of Step(). `simulated`: no person holds it, so that the run can be saved.</summary>
        public void PushedDevice (string role, string guard = null, Between between = Between.Hold, StepEffort stepEffort = StepEffort.LastTick,
                                  bool simulated = false)
        {
            using (var m = new MessageList())
            using (var text = new Texts (guard == null ? null : new[] { guard }))
            {
                var options = new Native.DeviceOptions { guard = text.First, between = between, step_effort = stepEffort, simulated = simulated ? 1 : 0 };
                options.size = (uint)Marshal.SizeOf (options);
                m.Check (Native.tactus_run_pushed_device (handle, Native.Utf8 (role), ref options, m.Pointer));
            }
        }

        public void Open()
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_open (handle, m.Pointer));
        }

        /// <summary>The reading that the next ticks use. Allocates nothing. [any thread, one at a time for each role]</summary>
        public void Push (string role, ref Reading reading) { Native.Check (Native.tactus_run_push (handle, Name (role), ref reading)); }

        /// <summary>The same with the velocity, in m/s and rad/s, for Between.ByVelocity: arrays of three, or null for the second.</summary>
        public void PushMoving (string role, ref Reading reading, double[] velocity, double[] angularVelocity = null)
        {
            if (velocity == null || velocity.Length != 3 || (angularVelocity != null && angularVelocity.Length != 3))
                throw new ArgumentException ("a velocity has three numbers");
            Native.Check (Native.tactus_run_push_moving (handle, Name (role), ref reading, velocity, angularVelocity));
        }

        /// <summary>The effort of the latest tick. Allocates nothing. [any thread]</summary>
        public void Take (string role, ref Effort effort)
        {
            unsafe { effort.Size = (uint)sizeof (Effort); }
            Native.Check (Native.tactus_run_take (handle, Name (role), ref effort));
        }

        /// <summary>Runs one tick, which counts as one period. [the thread of your loop]</summary>
        public void Tick() { Native.Check (Native.tactus_run_tick (handle)); }

        /// <summary>Runs one tick, this many seconds after the last one: for a loop that can be late.</summary>
        public void TickAfter (double passed) { Native.Check (Native.tactus_run_tick_after (handle, passed)); }

        /// <summary>Runs the ticks that are due this many seconds after the last step, at most 1: for a physics with steps longer than a tick.</summary>
        public void Step (double seconds) { Native.Check (Native.tactus_run_step_for (handle, seconds)); }

        /// <summary>The state of the run between two ticks (docs/states.md).</summary>
        public byte[] Save()
        {
            using (var m = new MessageList())
            {
                UIntPtr size;
                m.Check (Native.tactus_run_save (handle, null, UIntPtr.Zero, out size, m.Pointer));
                var state = new byte[(int)size];
                m.Check (Native.tactus_run_save (handle, state, size, out size, m.Pointer));
                return state;
            }
        }

        /// <summary>Goes back, or on, to a state of a run of the same graph. One that does not fit is refused, and changes nothing.</summary>
        public void Restore (byte[] state)
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_restore (handle, state, (UIntPtr)state.Length, m.Pointer));
        }

        /// <summary>Why there is no force. Allocates nothing. [any thread]</summary>
        public Guard GuardOf (string role)
        {
            var guard = new Guard();
            unsafe { guard.Size = (uint)sizeof (Guard); }
            Native.Check (Native.tactus_run_guard (handle, Name (role), ref guard));
            return guard;
        }

        /// <summary>The latest stop of a role in words. [any thread]</summary>
        public string GuardText (string role) { return Native.Taken (Native.tactus_run_guard_text (handle, Name (role))); }

        /// <summary>Runs many ticks, and returns their records, row after row.</summary>
        public double[] Steps (int ticks, double[] feeds = null)
        {
            if (feeds != null && feeds.Length != ticks * (int)Native.tactus_run_feed_count (handle))
                throw new ArgumentException ("one value for each tick and feed");
            var records = new double[ticks * (int)Native.tactus_run_record_count (handle)];
            Native.Check (Native.tactus_run_steps (handle, (UIntPtr)ticks, feeds, records));
            return records;
        }

        /// <summary>Ticks the run in real time, on a thread of the library. Call Attend() several times a second while it plays.</summary>
        public void Start()
        {
            var options = new Native.StartOptions { core = -1 };
            options.size = (uint)Marshal.SizeOf (options);
            using (var m = new MessageList()) m.Check (Native.tactus_run_start (handle, ref options, m.Pointer));
        }

        public void Attend()
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_attend (handle, m.Pointer));
        }

        /// <summary>Brings all forces to zero, and ends the tick thread. Waits for it.</summary>
        public void Stop() { Native.Check (Native.tactus_run_stop (handle)); }

        /// <summary>[any thread]</summary>
        public Status Status
        {
            get
            {
                var status = new Status();
                status.Size = (uint)Marshal.SizeOf (status);
                Native.Check (Native.tactus_run_status (handle, ref status));
                return status;
            }
        }

        /// <summary>Sets a parameter by name: "drag.mu".</summary>
        public void Set (string param, double value)
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_set (handle, Native.Utf8 (param), value, m.Pointer));
        }

        /// <summary>Turns a control, from 0 to 1.</summary>
        public void Turn (string control, double value)
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_turn (handle, Native.Utf8 (control), value, m.Pointer));
        }

        /// <summary>Triggers a hit input, "ring.hit", in m/s.</summary>
        public void Hit (string input, double speed)
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_hit (handle, Native.Utf8 (input), speed, m.Pointer));
        }

        /// <summary>Plays an edited graph from the next tick on.</summary>
        public void Edit (Graph graph)
        {
            using (var m = new MessageList()) m.Check (Native.tactus_run_edit (handle, graph.Handle, m.Pointer));
        }

        /// <summary>Fades all forces to zero, until Rearm(). [any thread]</summary>
        public void EmergencyStop() { Native.Check (Native.tactus_run_emergency_stop (handle)); }

        /// <summary>Ends all stops. Only a person should decide this. [any thread]</summary>
        public void Rearm() { Native.Check (Native.tactus_run_rearm (handle)); }

        public void Dispose() { handle.Dispose(); }

        byte[] Name (string role)
        {
            byte[] name;
            if (names.TryGetValue (role, out name)) return name;
            throw new ArgumentException ("the graph has no role \"" + role + "\"");
        }
    }

    // ---------------------------------------------------------------------------------------------------------------------------------

    /// <summary>Handles are freed once, and never while a call uses them.</summary>
    internal sealed class GraphHandle : SafeHandle
    {
        public GraphHandle() : base (IntPtr.Zero, true) {}
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
        protected override bool ReleaseHandle()
        {
            Native.tactus_graph_free (handle);
            return true;
        }
    }

    internal sealed class RunHandle : SafeHandle
    {
        public RunHandle() : base (IntPtr.Zero, true) {}
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
        protected override bool ReleaseHandle()
        {
            Native.tactus_run_free (handle);
            return true;
        }
    }

    /// <summary>The messages of one call.</summary>
    internal sealed class MessageList : IDisposable
    {
        public readonly IntPtr Pointer = Native.tactus_messages_create();

        public void Check (int result)
        {
            if (result == Native.misuse) Native.Check (result);
            if (result != Native.ok) throw Failure();
        }

        public TactusException Failure()
        {
            var all = new List<Message>();
            for (int i = 0; i < (int)Native.tactus_messages_count (Pointer); ++i)
            {
                var m = new Native.MessageStruct();
                m.size = (uint)Marshal.SizeOf (m);
                if (Native.tactus_messages_get (Pointer, (UIntPtr)i, ref m) != Native.ok) continue;
                all.Add (new Message { IsError = m.is_error != 0, Id = Native.Text (m.id), Where = Native.Text (m.where), Text = Native.Text (m.text),
                                       Remedy = Native.Text (m.remedy), File = Native.Text (m.file), Line = m.line, Column = m.column });
            }
            return new TactusException (all);
        }

        public void Dispose() { Native.tactus_messages_free (Pointer); }
    }

    /// <summary>Texts in memory that the garbage collector does not move.</summary>
    internal sealed class Texts : IDisposable
    {
        readonly IntPtr[] texts;
        public readonly IntPtr Pointer = IntPtr.Zero;

        public Texts (string[] all)
        {
            texts = new IntPtr[all == null ? 0 : all.Length];
            if (texts.Length == 0) return;
            Pointer = Marshal.AllocHGlobal (texts.Length * IntPtr.Size);
            for (int i = 0; i < texts.Length; ++i)
            {
                var bytes = Native.Utf8 (all[i]);
                texts[i] = Marshal.AllocHGlobal (bytes.Length);
                Marshal.Copy (bytes, 0, texts[i], bytes.Length);
                Marshal.WriteIntPtr (Pointer, i * IntPtr.Size, texts[i]);
            }
        }

        public UIntPtr Count { get { return (UIntPtr)texts.Length; } }
        public IntPtr First { get { return texts.Length > 0 ? texts[0] : IntPtr.Zero; } }

        public void Dispose()
        {
            foreach (var text in texts) Marshal.FreeHGlobal (text);
            Marshal.FreeHGlobal (Pointer);
        }
    }

    internal static class Native
    {
        public const int channels = 32, ok = 0, misuse = 2;
#if UNITY_IOS && ! UNITY_EDITOR
        const string library = "__Internal";
#else
        const string library = "libtactus";
#endif
        const CallingConvention c = CallingConvention.Cdecl;

        public static void Check (int result)
        {
            if (result == ok) return;
            if (result == misuse) throw new InvalidOperationException (Text (tactus_last_misuse()));
            throw new TactusException (new List<Message>());
        }

        /// <summary>UTF-8 with a zero at its end. On Windows, the marshaller would convert a string to the code page.</summary>
        public static byte[] Utf8 (string text) { return text == null ? null : Encoding.UTF8.GetBytes (text + "\0"); }

        /// <summary>Text that belongs to the library.</summary>
        public static string Text (IntPtr text)
        {
            if (text == IntPtr.Zero) return "";
            int length = 0;
            while (Marshal.ReadByte (text, length) != 0) ++length;
            var bytes = new byte[length];
            Marshal.Copy (text, bytes, 0, length);
            return Encoding.UTF8.GetString (bytes);
        }

        /// <summary>Text that the library has allocated for the caller.</summary>
        public static string Taken (IntPtr text)
        {
            try { return Text (text); }
            finally { tactus_text_free (text); }
        }

        [StructLayout (LayoutKind.Sequential)]
        public struct MessageStruct
        {
            public uint size;
            public int is_error;
            public IntPtr id, where, text, remedy, file;
            public int line, column;
        }

        [StructLayout (LayoutKind.Sequential)]
        public struct RunOptions
        {
            public uint size;
            public double rate_hz;
            public IntPtr feeds;
            public UIntPtr feed_count;
            public IntPtr records;
            public UIntPtr record_count;
            public IntPtr sets;
            public UIntPtr set_count;
            public IntPtr assets, asset_context, log;
        }

        [StructLayout (LayoutKind.Sequential)]
        public struct DeviceOptions
        {
            public uint size;
            public IntPtr axes;
            public UIntPtr axis_count;
            public IntPtr efforts;
            public UIntPtr effort_count;
            public IntPtr buttons;
            public UIntPtr button_count;
            public int signal_inputs, signal_outputs;
            public IntPtr guard;
            public double brake;
            public Between between;
            public StepEffort step_effort;
            public int simulated;
        }

        [StructLayout (LayoutKind.Sequential)]
        public struct StartOptions
        {
            public uint size;
            public int core;
            public ulong length;
            public UIntPtr buffer;
        }

        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_version();
        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_last_misuse();
        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_nodes_json();
        [DllImport (library, CallingConvention = c)] public static extern void tactus_text_free (IntPtr text);

        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_messages_create();
        [DllImport (library, CallingConvention = c)] public static extern void tactus_messages_free (IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern UIntPtr tactus_messages_count (IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_messages_get (IntPtr messages, UIntPtr index, ref MessageStruct message);

        [DllImport (library, CallingConvention = c)] public static extern GraphHandle tactus_graph_create (byte[] name, double rate_hz, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern GraphHandle tactus_graph_load (byte[] path, IntPtr messages);
        [DllImport (library, CallingConvention = c)]
        public static extern GraphHandle tactus_graph_parse (byte[] text, UIntPtr length, byte[] folder, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern void tactus_graph_free (IntPtr graph);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_graph_save (GraphHandle graph, byte[] path, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_graph_text (GraphHandle graph);
        [DllImport (library, CallingConvention = c)] public static extern double tactus_graph_rate (GraphHandle graph);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_graph_add_node (GraphHandle graph, byte[] patch, byte[] name, byte[] type, IntPtr messages);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_graph_set_param (GraphHandle graph, byte[] patch, byte[] node, byte[] param, byte[] value, IntPtr messages);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_graph_add_wire (GraphHandle graph, byte[] patch, byte[] wire, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_graph_undo (GraphHandle graph);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_graph_redo (GraphHandle graph);

        [DllImport (library, CallingConvention = c)]
        public static extern RunHandle tactus_run_create (GraphHandle graph, ref RunOptions options, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern void tactus_run_free (IntPtr run);
        [DllImport (library, CallingConvention = c)] public static extern double tactus_run_rate (RunHandle run);
        [DllImport (library, CallingConvention = c)] public static extern UIntPtr tactus_run_role_count (RunHandle run);
        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_run_role (RunHandle run, UIntPtr index);
        [DllImport (library, CallingConvention = c)] public static extern UIntPtr tactus_run_feed_count (RunHandle run);
        [DllImport (library, CallingConvention = c)] public static extern UIntPtr tactus_run_record_count (RunHandle run);
        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_run_record_name (RunHandle run, UIntPtr index);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_device (RunHandle run, byte[] role, byte[] device, IntPtr messages);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_run_pushed_device (RunHandle run, byte[] role, ref DeviceOptions options, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_open (RunHandle run, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_push (RunHandle run, byte[] role, ref Reading reading);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_run_push_moving (RunHandle run, byte[] role, ref Reading reading, double[] velocity, double[] angular_velocity);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_take (RunHandle run, byte[] role, ref Effort effort);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_tick (RunHandle run);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_tick_after (RunHandle run, double passed_s);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_step_for (RunHandle run, double dt_s);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_run_save (RunHandle run, [Out] byte[] bytes, UIntPtr room, out UIntPtr size, IntPtr messages);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_run_restore (RunHandle run, byte[] bytes, UIntPtr size, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_guard (RunHandle run, byte[] role, ref Guard guard);
        [DllImport (library, CallingConvention = c)] public static extern IntPtr tactus_run_guard_text (RunHandle run, byte[] role);
        [DllImport (library, CallingConvention = c)]
        public static extern int tactus_run_steps (RunHandle run, UIntPtr ticks, double[] feeds, [Out] double[] records);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_start (RunHandle run, ref StartOptions options, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_attend (RunHandle run, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_stop (RunHandle run);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_status (RunHandle run, ref Status status);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_set (RunHandle run, byte[] param, double value, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_turn (RunHandle run, byte[] control, double value, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_hit (RunHandle run, byte[] input, double speed, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_edit (RunHandle run, GraphHandle graph, IntPtr messages);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_emergency_stop (RunHandle run);
        [DllImport (library, CallingConvention = c)] public static extern int tactus_run_rearm (RunHandle run);
    }
}
