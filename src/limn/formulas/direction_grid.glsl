// Directions on the unit sphere by places in a unit square, and the frame of the parallel projection from each (the coherent shadow map
// specification, 2.1 to 2.3). y is up; theta is counted from it, phi from z to x.
#pragma once

const int EVEN_GRID = 0;       // cells of equal area: theta = acos(1 - 2 s), phi = 2 pi t
const int POLAR_GRID = 1;      // theta = pi s, phi = 2 pi t: denser at the poles
const int OCTAHEDRAL_GRID = 2; // the square folded to an octahedron, whose upper half is in the middle

const float GRID_PI = 3.14159265358979f;

// The axes of a map's picture, and the direction from the middle towards its eye.
struct MapFrame {
    vec3 right;
    vec3 up;
    vec3 towards;
};

FORMULA vec2 fold_octahedron(const vec2 p)
{
    float x = (1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f);
    float y = (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f);
    return vec2(x, y);
}

// The turn from z to x as a part of a whole one, in [0, 1]: arctangent by the odd polynomial of degree 15 with the least greatest error, 6e-9.
FORMULA float turn_about_y(const float x, const float z)
{
    float far = max(abs(x), abs(z));
    float a = far > 0.0f ? min(abs(x), abs(z)) / far : 0.0f;
    float q = a * a;
    float eighth = a * (0.159154837f + q * (-0.053046121f + q * (0.0317459452f + q * (-0.0221362715f + q * (0.0153460338f + q * (-0.00889872337f + q * (0.00347959795f - 0.000645304452f * q)))))));
    float quarter = abs(x) > abs(z) ? 0.25f - eighth : eighth;
    float half_turn = z < 0.0f ? 0.5f - quarter : quarter;
    return x < 0.0f ? 1.0f - half_turn : half_turn;
}

// The place of a unit direction, in [0, 1].
FORMULA vec2 place_of_direction(const int kind, const vec3 d)
{
    if (kind == OCTAHEDRAL_GRID) {
        vec2 p = vec2(d.x, d.z) / (abs(d.x) + abs(d.y) + abs(d.z));
        if (d.y < 0.0f)
            p = fold_octahedron(p);
        return clamp(p * 0.5f + vec2(0.5f, 0.5f), vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
    }
    float s = kind == POLAR_GRID ? 2.0f * turn_about_y(length(vec2(d.x, d.z)), d.y) : 0.5f - 0.5f * d.y;
    return clamp(vec2(s, turn_about_y(d.x, d.z)), vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
}

// The frame of the map at a place. Its axes are those of the sphere, right along phi and up against theta.
FORMULA MapFrame frame_of_place(const int kind, const vec2 place)
{
    float cosine = 0.0f; // of theta and phi
    float sine = 0.0f;
    float across = 1.0f;
    float along = 0.0f;
    if (kind == OCTAHEDRAL_GRID) {
        vec2 p = place * 2.0f - vec2(1.0f, 1.0f);
        float height = 1.0f - abs(p.x) - abs(p.y);
        if (height < 0.0f)
            p = fold_octahedron(p);
        float far = length(p);
        float all = sqrt(far * far + height * height);
        cosine = height / all;
        sine = far / all;
        if (far > 0.0f) {
            across = p.y / far;
            along = p.x / far;
        }
    } else {
        if (kind == POLAR_GRID) {
            cosine = cos(GRID_PI * place.x);
            sine = sin(GRID_PI * place.x);
        } else {
            cosine = 1.0f - 2.0f * place.x;
            sine = 2.0f * sqrt(max(place.x * (1.0f - place.x), 0.0f));
        }
        across = cos(2.0f * GRID_PI * place.y);
        along = sin(2.0f * GRID_PI * place.y);
    }
    vec3 right = vec3(across, 0.0f, -along);
    vec3 up = vec3(-cosine * along, sine, -cosine * across);
    vec3 towards = vec3(sine * along, cosine, sine * across);
    MapFrame frame = {right, up, towards};
    return frame;
}
