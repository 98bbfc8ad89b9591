// Puts the colliders of a file of `bodice export --to unity` on a body, and gives them to its cloth.
// Copy this file into Assets, the JSON beside it, add the component to the body's root, and assign both fields;
// then choose "Build colliders" from the component's menu while the body is in its bind pose.
using System;
using System.Collections.Generic;
using UnityEngine;

public class BodiceColliders : MonoBehaviour
{
    [Serializable]
    public class Shape
    {
        public string bone, part;
        public Vector3 a, b;  // in the bone's coordinates, or this object's where there is no bone
        public float radiusA, radiusB;
    }

    [Serializable]
    public class File
    {
        public string format, proxy;
        public int version;
        public Shape[] shapes;
    }

    public TextAsset colliders;
    public Cloth cloth;  // may be left empty

    [ContextMenu("Build colliders")]
    public void Build()
    {
        var file = JsonUtility.FromJson<File>(colliders.text);
        if (file == null || file.version != 1)
        {
            Debug.LogError($"{colliders.name}: not a file of version 1 of bodice's colliders. Export it again.", this);
            return;
        }
        var bones = new Dictionary<string, Transform> { { "", transform } };
        foreach (var child in GetComponentsInChildren<Transform>()) bones.TryAdd(child.name, child);
        var capsules = new List<CapsuleCollider>();
        var pairs = new List<ClothSphereColliderPair>();
        foreach (var shape in file.shapes)
        {
            if (!bones.TryGetValue(shape.bone, out var bone))
            {
                Debug.LogError($"{colliders.name}: this body has no bone {shape.bone}. Fit and export its own rig.", this);
                return;
            }
            if (shape.a == shape.b)
                pairs.Add(new ClothSphereColliderPair(AddSphere(bone, shape.part, shape.a, shape.radiusA)));
            else if (shape.radiusA == shape.radiusB)
                capsules.Add(AddCapsule(bone, shape));
            else  // cloth takes the hull of two spheres; rigid bodies collide with the spheres alone
                pairs.Add(new ClothSphereColliderPair(AddSphere(bone, shape.part, shape.a, shape.radiusA),
                                                      AddSphere(bone, shape.part, shape.b, shape.radiusB)));
        }
        if (cloth == null) return;
        if (capsules.Count > 32 || pairs.Count > 16)
            Debug.LogWarning("Cloth takes 32 capsules and 32 spheres, which are 16 tapered capsules: export fewer.", this);
        cloth.capsuleColliders = capsules.ToArray();
        cloth.sphereColliders = pairs.ToArray();
    }

    static GameObject Add(Transform bone, string part, Vector3 at, Quaternion turn)
    {
        var child = new GameObject("collider_" + part);
        child.transform.SetParent(bone, false);
        child.transform.localPosition = at;
        child.transform.localRotation = turn;
        return child;
    }

    static SphereCollider AddSphere(Transform bone, string part, Vector3 at, float radius)
    {
        var sphere = Add(bone, part, at, Quaternion.identity).AddComponent<SphereCollider>();
        sphere.radius = radius;
        return sphere;
    }

    static CapsuleCollider AddCapsule(Transform bone, Shape shape)
    {
        var turn = Quaternion.FromToRotation(Vector3.up, shape.b - shape.a);
        var capsule = Add(bone, shape.part, 0.5f * (shape.a + shape.b), turn).AddComponent<CapsuleCollider>();
        capsule.radius = shape.radiusA;
        capsule.height = (shape.b - shape.a).magnitude + 2 * shape.radiusA;  // along y, with both caps
        return capsule;
    }
}
