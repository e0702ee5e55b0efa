// SPDX-License-Identifier: MIT
// Plays presets through Tactus.cs, and prints what csharp_test.py compares with other ways to know it.
using System;
using System.IO;
using Tactus;

static class Test
{
    static string Bits (double value) { return BitConverter.DoubleToInt64Bits (value).ToString ("x16"); }

    /// Records of ticks, as bits: one line per tick.
    static void Render (string graph_file, int ticks)
    {
        using (var graph = Graph.Load (graph_file))
        using (var run = new Run (graph))
        {
            Console.WriteLine (string.Join (" ", run.RecordNames));
            run.Open();
            var records = run.Steps (ticks);
            var width = run.RecordNames.Length;
            for (int tick = 0; tick < ticks; ++tick)
            {
                var line = new string[width];
                for (int i = 0; i < width; ++i) line[i] = Bits (records[tick * width + i]);
                Console.WriteLine (string.Join (" ", line));
            }
        }
    }

    /// The force on a pushed tool: one line per tick. After `silent` ticks, the readings stop.
    static void Push (string graph_file, int ticks, int silent)
    {
        using (var graph = Graph.Load (graph_file))
        using (var run = new Run (graph))
        {
            var role = run.Roles[0];
            run.PushedDevice (role, "{\"max_force\": \"2 N\"}");
            run.Open();
            var effort = Effort.None();
            for (int tick = 0; tick < ticks; ++tick)
            {
                var reading = Reading.At (0.0, 0.0, 0.03 - 0.0001 * tick);
                if (tick < silent) run.Push (role, ref reading);
                run.Tick();
                run.Take (role, ref effort);
                Console.WriteLine (Bits (effort.X) + " " + Bits (effort.Y) + " " + Bits (effort.Z));
            }
        }
    }

    /// The force on a tool that moves, for each step; then whether a saved half has the same bits again, and what the guard says.
    static void Step (string graph_file, int steps)
    {
        using (var graph = Graph.Load (graph_file))
        using (var run = new Run (graph))
        {
            var role = run.Roles[0];
            run.PushedDevice (role, "{\"max_impulse\": \"1 N*s\", \"impulse_window\": \"10 s\"}", Between.ByVelocity, StepEffort.Mean, true);
            run.Open();
            var effort = Effort.None();
            var velocity = new[] { 0.01, 0.0, -0.05 };
            Func<int, int, string[]> part = (first, last) => {
                var forces = new string[last - first];
                for (int k = first; k < last; ++k)
                {
                    var reading = Reading.At (0.00003 * k, 0.0, 0.002 - 0.0001 * k);
                    run.PushMoving (role, ref reading, velocity);
                    run.Step (0.0017);
                    run.Take (role, ref effort);
                    forces[k - first] = Bits (effort.X) + " " + Bits (effort.Y) + " " + Bits (effort.Z);
                }
                return forces;
            };
            foreach (var line in part (0, steps / 2)) Console.WriteLine (line);
            var state = run.Save();
            var half = part (steps / 2, steps);
            foreach (var line in half) Console.WriteLine (line);
            run.Restore (state);
            Console.WriteLine (string.Join (",", part (steps / 2, steps)) == string.Join (",", half));
            state[state.Length - 1] ^= 1;
            try { run.Restore (state); }
            catch (TactusException e) { Console.WriteLine (e.Messages[0].Id); }
            Console.WriteLine (run.GuardOf (role).Stop + " " + run.GuardOf (role).Limit + " " + run.GuardText (role).Contains ("impulse"));
            for (int k = 0; k < 1000 && run.GuardOf (role).IsLatched == 0; ++k) part (steps - 1, steps);
            Console.WriteLine (run.GuardOf (role).Stop + " " + run.GuardOf (role).Limit.ToString ("R") + " " + run.GuardText (role).Contains ("impulse"));
        }
    }

    /// How often the garbage collector runs while a loop plays: the smallest object per call would fill its nursery of 4 MB.
    static void Collections (string graph_file)
    {
        using (var graph = Graph.Load (graph_file))
        using (var run = new Run (graph))
        {
            var role = run.Roles[0];
            run.PushedDevice (role);
            run.Open();
            var effort = Effort.None();
            var reading = Reading.At (0.0, 0.0, -0.001);
            run.Push (role, ref reading);
            run.Take (role, ref effort);
            run.Tick();
            GC.Collect();
            var before = GC.CollectionCount (0);
            for (int tick = 0; tick < 300000; ++tick)
            {
                run.Push (role, ref reading);
                run.Tick();
                run.Take (role, ref effort);
            }
            Console.WriteLine (GC.CollectionCount (0) - before);
        }
    }

    static void Errors (string folder)
    {
        try { Graph.Load (Path.Combine (folder, "no such graph.json")); }
        catch (TactusException e) { Console.WriteLine (e.Messages[0].Id + " " + e.Messages[0].IsError); }
        try { Graph.Parse ("{"); }
        catch (TactusException e) { Console.WriteLine (e.Messages[0].Id + " " + e.Messages[0].Line); }
        using (var graph = Graph.Create ("größe", 1000.0))
        {
            Console.WriteLine (graph.RateHz);
            graph.AddNode ("g", "signal.gain");
            Func<string, bool> has = text => graph.Text.Contains (text);
            Console.WriteLine (has ("größe") + " " + has ("signal.gain") + " " + graph.Undo() + " " + has ("signal.gain"));
            try { graph.AddNode ("g", "no.such_node"); }
            catch (TactusException e) { Console.WriteLine (e.Messages[0].Id); }
            var file = Path.Combine (folder, "größe und länge.json");
            graph.Save (file);
            Console.WriteLine (File.Exists (file));
            using (var again = Graph.Load (file)) Console.WriteLine (again.Text == graph.Text);
        }
        var freed = Graph.Create ("freed", 1000.0);
        freed.Dispose();
        freed.Dispose();
        try { Console.WriteLine (freed.Text); }
        catch (ObjectDisposedException) { Console.WriteLine ("disposed"); }
    }

    /// A run in real time that is stopped before it is freed, and one that is not.
    static void Play (string graph_file)
    {
        for (int i = 0; i < 2; ++i)
            using (var graph = Graph.Load (graph_file))
            using (var run = new Run (graph))
            {
                run.PushedDevice (run.Roles[0]);
                run.Open();
                run.Start();
                while (run.Status.Ticks < 100) run.Attend();
                run.EmergencyStop();
                Console.WriteLine (run.Status.Phase + " " + run.Status.IsEmergency);
                try { run.Tick(); }
                catch (InvalidOperationException e) { Console.WriteLine (e.Message.Length > 0); }
                if (i == 0) run.Stop();
                if (i == 0) Console.WriteLine (run.Status.Phase);
            }
    }

    static int Main (string[] words)
    {
        Console.OutputEncoding = new System.Text.UTF8Encoding (false);
        switch (words[0])
        {
        case "version": Console.WriteLine (Library.Version + " " + Library.NodesJson().Contains ("friction.elasto_plastic")); break;
        case "render": Render (words[1], int.Parse (words[2])); break;
        case "push": Push (words[1], int.Parse (words[2]), int.Parse (words[3])); break;
        case "step": Step (words[1], int.Parse (words[2])); break;
        case "collections": Collections (words[1]); break;
        case "errors": Errors (words[1]); break;
        case "play": Play (words[1]); break;
        default: return 2;
        }
        return 0;
    }
}
