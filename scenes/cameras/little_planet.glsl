// Stereographic: circles stay round. `zoom`: of what the picture's left and right borders show, the tangent of half the angle off
// the middle.
vec3 direction_of(vec2 place) {
  vec2 p = zoom * place;
  return vec3(2.0 * p, 1.0 - dot(p, p));
}

// Rays through one place meet on a sphere of radius `focus`.
vec3 origin(vec2 place, vec2 lens) {
  return vec3(aperture * lens, 0.0);
}

vec3 direction(vec2 place, vec2 lens) {
  if (length(place) > 0.98) return vec3(0.0);
  return focus * normalize(direction_of(place)) - origin(place, lens);
}
