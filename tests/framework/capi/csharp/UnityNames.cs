// SPDX-License-Identifier: MIT
// The names of Unity that docs/examples/unity uses, so that the example is compiled and its order of calls is tested without Unity.
using System;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3 (float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }
        public static Vector3 zero { get { return new Vector3 (0, 0, 0); } }
    }

    public class Transform { public Vector3 position; }

    public class MonoBehaviour { public Transform transform = new Transform(); }

    public static class Application { public static string streamingAssetsPath; }

    public static class Debug
    {
        public static void LogError (object text) { Console.WriteLine ("error " + text.ToString().Replace ('\n', ' ')); }
    }
}

namespace UnityEditor
{
    public static class AssemblyReloadEvents
    {
        public static event Action beforeAssemblyReload;
        public static void Reload()
        {
            if (beforeAssemblyReload != null) beforeAssemblyReload();
        }
    }
}

static class UnityTest
{
    static void Call (object on, string function)
    {
        on.GetType().GetMethod (function, System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Instance).Invoke (on, null);
    }

    static int Main (string[] words)
    {
        UnityEngine.Application.streamingAssetsPath = words[0];
        var tool = new HapticTool { preset = words[1] };
        tool.transform.position = new UnityEngine.Vector3 (0, -0.0005f, 0);
        Call (tool, "OnEnable");
        var pushed = 0.0f;
        var watch = System.Diagnostics.Stopwatch.StartNew();
        while (pushed == 0.0f && watch.ElapsedMilliseconds < 60000)
        {
            Call (tool, "Update");
            pushed = tool.Force().y;
        }
        Console.WriteLine ("pushes up " + (pushed > 0.0f));
        UnityEditor.AssemblyReloadEvents.Reload();
        Console.WriteLine ("after a reload " + tool.Force().y);
        Call (tool, "OnDisable");
        Call (tool, "OnEnable");
        Call (tool, "OnDisable");
        Console.WriteLine ("after the second play " + tool.Force().y);
        var wrong = new HapticTool { preset = "none.json" };
        Call (wrong, "OnEnable");
        Call (wrong, "Update");
        Console.WriteLine ("without a graph " + wrong.Force().y);
        return 0;
    }
}
