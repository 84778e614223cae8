layout(location = 0) in uint packed_point;
flat out uint point;

void main() { point = packed_point; }
