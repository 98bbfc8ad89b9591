// What BodiceColliders.cs uses of Unity, so that it can be compiled and run without Unity: transforms with names and places,
// components that keep their numbers. Main() reads a file of `bodice export --to unity`, builds its colliders on bones that lie
// at rest, and prints the ends and radii of each in the world.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static Vector3 up { get { return new Vector3(0, 1, 0); } }
        public float magnitude { get { return (float)Math.Sqrt(Dot(this, this)); } }
        public static float Dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
        public static Vector3 Cross(Vector3 a, Vector3 b)
        {
            return new Vector3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        }
        public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
        public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }
        public static Vector3 operator *(float k, Vector3 a) { return new Vector3(k * a.x, k * a.y, k * a.z); }
        public static bool operator ==(Vector3 a, Vector3 b) { return (a - b).magnitude < 1e-5f; }
        public static bool operator !=(Vector3 a, Vector3 b) { return !(a == b); }
        public override bool Equals(object other) { return other is Vector3 && this == (Vector3)other; }
        public override int GetHashCode() { return 0; }
    }

    public struct Quaternion
    {
        public Vector3 v;
        public float w;
        public static Quaternion identity { get { return new Quaternion { w = 1 }; } }
        public static Quaternion FromToRotation(Vector3 from, Vector3 to)
        {
            Vector3 b = (1 / to.magnitude) * to, half = from + b;
            if (half.magnitude < 1e-6f) return new Quaternion { v = new Vector3(1, 0, 0), w = 0 };
            half = (1 / half.magnitude) * half;
            return new Quaternion { v = Vector3.Cross(from, half), w = Vector3.Dot(from, half) };
        }
        public static Vector3 operator *(Quaternion q, Vector3 p)
        {
            Vector3 t = 2 * Vector3.Cross(q.v, p);
            return p + q.w * t + Vector3.Cross(q.v, t);
        }
    }

    public class Object { public string name = ""; }

    public class Component : Object
    {
        public GameObject gameObject;
        public Transform transform { get { return gameObject.transform; } }
        public T[] GetComponentsInChildren<T>() where T : Component { return Transform.All.OfType<T>().ToArray(); }
    }

    public class MonoBehaviour : Component { }

    public class Transform : Component
    {
        public static readonly List<Transform> All = new List<Transform>();
        public Transform parent;
        public Vector3 localPosition;
        public Quaternion localRotation = Quaternion.identity;
        public float[] rest;  // rows of a bone's matrix, in place of a parent
        public void SetParent(Transform to, bool worldPositionStays) { parent = to; }
        public Vector3 ToWorld(Vector3 p)
        {
            if (rest != null)
                return new Vector3(rest[0] * p.x + rest[1] * p.y + rest[2] * p.z + rest[3],
                                   rest[4] * p.x + rest[5] * p.y + rest[6] * p.z + rest[7],
                                   rest[8] * p.x + rest[9] * p.y + rest[10] * p.z + rest[11]);
            Vector3 q = localPosition + localRotation * p;
            return parent == null ? q : parent.ToWorld(q);
        }
    }

    public class GameObject : Object
    {
        public readonly Transform transform;
        public GameObject(string name)
        {
            this.name = name;
            transform = new Transform { gameObject = this, name = name };
            Transform.All.Add(transform);
        }
        public T AddComponent<T>() where T : Component, new()
        {
            var made = new T { gameObject = this };
            if (made is Collider) Collider.All.Add((Collider)(Component)made);
            return made;
        }
    }

    public class Collider : Component { public static readonly List<Collider> All = new List<Collider>(); }
    public class SphereCollider : Collider { public float radius; }
    public class CapsuleCollider : Collider { public float radius, height; }  // along y

    public struct ClothSphereColliderPair
    {
        public SphereCollider first, second;
        public ClothSphereColliderPair(SphereCollider a, SphereCollider b = null) { first = a; second = b; }
    }

    public class Cloth : Component
    {
        public CapsuleCollider[] capsuleColliders = new CapsuleCollider[0];
        public ClothSphereColliderPair[] sphereColliders = new ClothSphereColliderPair[0];
    }

    public class TextAsset : Object { public string text; }

    public class ContextMenuAttribute : Attribute { public ContextMenuAttribute(string name) { } }

    public static class Debug
    {
        public static void LogError(string text, Object about) { throw new Exception(text); }
        public static void LogWarning(string text, Object about) { Console.Error.WriteLine(text); }
    }

    public static class JsonUtility
    {
        // Reads the file's own layout: one value a line.
        public static T FromJson<T>(string text)
        {
            object file = new BodiceColliders.File
            {
                format = "", proxy = "", version = int.Parse(Regex.Match(text, "\"version\": (\\d+)").Groups[1].Value),
                shapes = Regex.Matches(text.Substring(text.IndexOf("\"shapes\"")),
                    "\"bone\": \"(.*?)\",\\s*\"part\": \"(.*?)\",\\s*\"a\": \\{(.*?)\\},\\s*\"b\": \\{(.*?)\\},\\s*" +
                    "\"radiusA\": (.*?),\\s*\"radiusB\": (.*?)\\s*\\}", RegexOptions.Singleline).Cast<Match>().Select(m =>
                    new BodiceColliders.Shape
                    {
                        bone = m.Groups[1].Value, part = m.Groups[2].Value, a = Point(m.Groups[3].Value),
                        b = Point(m.Groups[4].Value), radiusA = Number(m.Groups[5].Value), radiusB = Number(m.Groups[6].Value)
                    }).ToArray()
            };
            return (T)file;
        }
        static float Number(string text) { return float.Parse(text, CultureInfo.InvariantCulture); }
        static Vector3 Point(string text)
        {
            var v = Regex.Matches(text, ": ([-+.0-9eE]+)").Cast<Match>().Select(m => Number(m.Groups[1].Value)).ToArray();
            return new Vector3(v[0], v[1], v[2]);
        }
    }
}

public static class UnityStandIn
{
    public static void Main(string[] arguments)
    {
        CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        string text = File.ReadAllText(arguments[0]);
        foreach (Match m in Regex.Matches(text, "\"name\": \"(.*?)\",\\s*\"rest\": \\[(.*?)\\]", RegexOptions.Singleline))
            new UnityEngine.GameObject(m.Groups[1].Value).transform.rest = m.Groups[2].Value.Split(',')
                .Select(v => float.Parse(v, CultureInfo.InvariantCulture)).ToArray();
        var body = new UnityEngine.GameObject("body_root");
        var script = body.AddComponent<BodiceColliders>();
        script.colliders = new UnityEngine.TextAsset { name = arguments[0], text = text };
        script.cloth = body.AddComponent<UnityEngine.Cloth>();
        script.Build();
        foreach (var capsule in script.cloth.capsuleColliders)
        {
            float half = 0.5f * capsule.height - capsule.radius;
            Print(capsule.transform, new UnityEngine.Vector3(0, half, 0), capsule.radius, capsule.transform,
                  new UnityEngine.Vector3(0, -half, 0), capsule.radius);
        }
        foreach (var pair in script.cloth.sphereColliders)
        {
            var second = pair.second ?? pair.first;
            Print(pair.first.transform, new UnityEngine.Vector3(), pair.first.radius, second.transform,
                  new UnityEngine.Vector3(), second.radius);
        }
    }

    static void Print(UnityEngine.Transform a, UnityEngine.Vector3 p, float radiusA, UnityEngine.Transform b,
                      UnityEngine.Vector3 q, float radiusB)
    {
        UnityEngine.Vector3 u = a.ToWorld(p), v = b.ToWorld(q);
        Console.WriteLine("{0} {1} {2} {3} {4} {5} {6} {7}", u.x, u.y, u.z, v.x, v.y, v.z, radiusA, radiusB);
    }
}
