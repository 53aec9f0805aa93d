const int n = 3 > 2 && !false ? 0x10 : 017;
float h(float x);
float f(vec3 p) { uint u = uint(p.x) * 2654435769u; return h(float(u >> 7u)) + float(n % -5) + float(~n ^ n); }
float h(float x) { if (x > 2.0) return pow(abs(x), 1.5) + atan(x, 3.0) + sign(x); }
