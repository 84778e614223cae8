layout(location = 0) out uint mark;

void main() { mark = 1u; }
