// A piece of line on the device, in the model's frame.
struct Segment {
    vec4 a; // w: ink
    vec4 b;
    uint face;
    uint id_a; // half-edge that the end lies on, or 3 * faces + vertex; all ones where it lies inside the face
    uint id_b;
    uint other; // on creases: the face on the other side; all ones elsewhere
};
