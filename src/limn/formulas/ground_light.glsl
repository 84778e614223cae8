// How much light reaches a place of a ground, in [0,1], between the places where it is known. Includes ask for `float ground_value(const ivec2)`, and
// for pattern_picture.glsl before.

FORMULA float ground_light(const GroundGrid g, const vec3 place)
{
    vec3 d = place - g.middle;
    float cells = float(g.side - 1);
    vec2 share = vec2(dot(d, g.right), dot(d, g.ahead)) / (2.0f * g.reach) + vec2(0.5f, 0.5f);
    vec2 at = share * cells;
    if (!(at.x >= 0.0f && at.y >= 0.0f && at.x <= cells && at.y <= cells))
        return 1.0f;
    ivec2 low = min(ivec2(at), ivec2(g.side - 2, g.side - 2));
    vec2 f = at - vec2(low);
    float before = mix(ground_value(low), ground_value(low + ivec2(1, 0)), f.x);
    float after = mix(ground_value(low + ivec2(0, 1)), ground_value(low + ivec2(1, 1)), f.x);
    vec2 off = abs(share - vec2(0.5f, 0.5f)) * 2.0f;
    return mix(mix(before, after, f.y), 1.0f, smoothstep(0.8f, 1.0f, max(off.x, off.y)));
}
