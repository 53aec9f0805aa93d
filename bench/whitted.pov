// scenes/whitted.toml for POV-Ray 3.7: same geometry, camera, light and depth, so that `eyeray-bench` can time both.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 9 adc_bailout 0.001 ambient_light rgb 0.4 }

background { rgb <0.34, 0.55, 0.85> }

// 60 degrees vertically; the negative x makes POV-Ray's left-handed world eyeray's right-handed one.
#declare aspect = image_width / image_height;
camera {
  location <8, 2, -4>
  right -aspect * x
  up y
  angle 2 * degrees(atan(tan(radians(30)) * aspect))
  look_at <4, 2.3, -4>
}

light_source { <60, 40, 0> color rgb 1 }

// The floor. The checks are cubes: half a unit down puts their faces away from the surface.
mesh {
  triangle { <-16, 0, 8>, <16, 0, 8>, <16, 0, -8> }
  triangle { <-16, 0, 8>, <16, 0, -8>, <-16, 0, -8> }
  pigment { checker rgb <0.8, 0.3, 0.15> rgb <0.9, 0.85, 0.05> translate 0.5 * y }
  finish { ambient 1 diffuse 1 }
}

// The metal; ambient is a share of the pigment here.
sphere {
  <2, 1.5, -2.5>, 1
  pigment { rgb <0.07, 0.2, 0.24> }
  finish { ambient 1 diffuse 1 phong 0.8 phong_size 64 reflection rgb <0.6, 0.68, 0.7> }
}

// The glass: a shell, since POV-Ray's Fresnel term does not know of a medium around an object.
#declare clear = texture {
  pigment { rgbf 1 }
  finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel on } conserve_energy }
}
difference {
  sphere { <4, 2.3, -4>, 1 texture { clear finish { phong 0.9 phong_size 200 } } }
  sphere { <4, 2.3, -4>, 0.96 texture { clear } }
  interior { ior 1.4 }
}
