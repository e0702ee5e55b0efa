// SPDX-License-Identifier: MIT
// Plays a preset on the tool that this object follows. Put Tactus.cs, this file and the library (libtactus.dll or libtactus.so, in Assets/Plugins)
// into a Unity project, allow "unsafe" code in the player settings, and add this component to an object that the hand moves.
//
// Your device driver calls Force() and sends it; this component itself drives no motor. The library ticks in real time on a thread of its own.
// Readings come once per frame, so the watchdog of the guard is 0.1 s; a driver that has readings more often pushes them itself.
using System.IO;
using Tactus;
using UnityEngine;

public class HapticTool : MonoBehaviour
{
    public string preset = "dry_wood.json";   // in Assets/StreamingAssets
    public string role = "stylus";
    public double maxForce = 2.0;             // N

    Run run;
    Effort effort = Effort.None();

    void OnEnable()
    {
#if UNITY_EDITOR
        UnityEditor.AssemblyReloadEvents.beforeAssemblyReload += Stop;   // the editor never unloads the library, and its threads would go on
#endif
        try
        {
            using (var graph = Graph.Load (Path.Combine (Application.streamingAssetsPath, preset)))
                run = new Run (graph);
            var force = maxForce.ToString (System.Globalization.CultureInfo.InvariantCulture);
            run.PushedDevice (role, "{\"max_force\": \"" + force + " N\", \"watchdog\": 0.1}");
            run.Open();
            run.Start();
        }
        catch (TactusException e)
        {
            foreach (var message in e.Messages) Debug.LogError (message.ToString());
            Stop();
        }
    }

    void OnDisable()
    {
#if UNITY_EDITOR
        UnityEditor.AssemblyReloadEvents.beforeAssemblyReload -= Stop;
#endif
        Stop();
    }

    void Update()
    {
        if (run == null) return;
        var p = transform.position;
        var reading = Reading.At (p.x, p.z, p.y);   // Unity: x right, y up, z forward
        run.Push (role, ref reading);
        run.Attend();
    }

    /// The force on the tool in N, in Unity's axes.
    public Vector3 Force()
    {
        if (run == null) return Vector3.zero;
        run.Take (role, ref effort);
        return new Vector3 ((float)effort.X, (float)effort.Z, (float)effort.Y);
    }

    void Stop()
    {
        if (run == null) return;
        run.Dispose();   // brings the force to zero, and waits for it
        run = null;
    }
}
