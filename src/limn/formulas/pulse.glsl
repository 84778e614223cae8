// Pulses of period 1 and their integrals (the procedural structures specification, 2.4 and 7.1).
#pragma once

// 1 in [edge, 1 - edge), else 0. x in [0,1).
FORMULA float pulse(const float edge, const float x)
{
    return step(edge, x) - step(1.0f - edge, x);
}

// Integral from 0 to x of the pulse that is 1 in [0, duty) of every period.
FORMULA float pulse_integral(const float x, const float duty)
{
    float k = floor(x);
    return k * duty + min(x - k, duty);
}

// The integral of that.
FORMULA float pulse_second_integral(const float x, const float duty)
{
    float k = floor(x);
    float f = x - k;
    float inside = f <= duty ? 0.5f * f * f : 0.5f * duty * duty + duty * (f - duty);
    return 0.5f * duty * k * (k - 1.0f) + k * (duty - 0.5f * duty * duty) + k * duty * f + inside;
}

// Its mean over a pixel in which x changes by a along one side and by b along the other, both positive.
FORMULA float pulse_box_mean(const float x, const float duty, const float a, const float b)
{
    float at = x - floor(x);
    float outer = 0.5f * (a + b);
    float inner = 0.5f * (a - b);
    float sum = pulse_second_integral(at + outer, duty) - pulse_second_integral(at + inner, duty) - pulse_second_integral(at - inner, duty) +
                pulse_second_integral(at - outer, duty);
    return sum / (a * b);
}
