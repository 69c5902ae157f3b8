// SPDX-License-Identifier: BSD-3-Clause
// Points are moved with their node, coloured, and shaded by what lies in front of them.
export const pointVertex = `
precision highp float;
precision highp int;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
uniform highp sampler2D poses;     // of each node: rotation; translation and mission
uniform sampler2D missions;        // colour, and whether the mission is shown
uniform sampler2D labels, ramp;
uniform bool moved;
uniform int colourBy;
uniform vec2 heights;
uniform float size, scale, grain;  // pixels; pixels a metre at one metre; metres
in vec4 position;
in uint node;
out vec3 colour;

vec4 texel(uint i) { return texelFetch(poses, ivec2(int(i % 1024u), int(i / 1024u)), 0); }

void main() {
  vec3 p = (modelMatrix * vec4(position.xyz, 1.0)).xyz;
  vec4 t = texel(2u * node + 1u), shown = texelFetch(missions, ivec2(int(t.w) % 256, 0), 0);
  if (shown.a < 0.5) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); gl_PointSize = 0.0; return; }
  float height = p.z;
  if (moved) {
    vec4 q = texel(2u * node);
    p += 2.0 * cross(q.xyz, cross(q.xyz, p) + q.w * p) + t.xyz;
  }
  float label = floor(position.w / 256.0), intensity = (position.w - 256.0 * label) / 255.0;
  if (colourBy == 0) colour = shown.rgb * (0.55 + 0.6 * intensity);
  else if (colourBy == 1) colour = texture(ramp, vec2(pow(clamp((height - heights.x) / (heights.y - heights.x), 0.0, 1.0), 0.6), 0.5)).rgb;
  else if (colourBy == 2) colour = mix(vec3(0.10, 0.16, 0.15), vec3(1.0, 0.98, 0.90), pow(intensity, 0.7));
  else colour = texelFetch(labels, ivec2(int(label), 0), 0).rgb;
  vec4 seen = viewMatrix * vec4(p, 1.0);
  gl_Position = projectionMatrix * seen;
  gl_PointSize = clamp(grain * scale / max(-seen.z, 0.01), size, 4.0 * size);
}`;

/// A round point; its colour is of its own (`in`) or of all (`uniform`).
const disc = colour => `
precision highp float;
${colour} vec3 colour;
out vec4 result;
void main() {
  vec2 d = gl_PointCoord - 0.5;
  if (dot(d, d) > 0.25) discard;
  result = vec4(colour, 1.0);
}`;

export const pointFragment = disc("in");
export const pairFragment = disc("uniform");

export const pairVertex = `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float size;
in vec3 position;
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(0.01 * position, 1.0);
  gl_PointSize = size;
}`;

export const screenVertex = `
precision highp float;
in vec3 position;
out vec2 at;
void main() { at = 0.5 * position.xy + 0.5; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

// Eye-dome lighting: C. Boucheny, "Visualisation scientifique de grands volumes de donnees", 2009.
export const screenFragment = `
precision highp float;
uniform sampler2D colours;
uniform highp sampler2D depths;
uniform vec2 pixel;
uniform float near, far, strength;
in vec2 at;
out vec4 result;

float depthAt(vec2 p) {
  float z = 2.0 * texture(depths, p).r - 1.0;
  return log2(2.0 * near * far / (far + near - z * (far - near)));
}

void main() {
  vec3 ground = mix(vec3(0.043, 0.082, 0.066), vec3(0.086, 0.157, 0.125), at.y);
  vec4 seen = texture(colours, at);
  if (texture(depths, at).r >= 1.0) { result = vec4(ground, 1.0); return; }
  float here = depthAt(at), hidden = 0.0;
  for (int i = 0; i < 8; ++i) {
    float a = 0.7853982 * float(i);
    float there = depthAt(at + pixel * 1.4 * vec2(cos(a), sin(a)));
    hidden += min(max(0.0, here - there), 0.35);
  }
  result = vec4(seen.rgb * exp(-strength * hidden / 8.0), 1.0);
}`;
