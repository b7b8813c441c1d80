// Impostors: an atom is one point, a bond one rectangle; the fragment shader makes them round. All
// of it is orthographic, so a pixel has one size everywhere.

const shading = `
  uniform vec3 background;
  uniform float depthCue;
  vec3 shaded(vec3 color, vec3 normal, float depth, float kept) {
    float light = max(0.0, dot(normal, normalize(vec3(-0.35, 0.55, 0.76))));
    float shine = pow(max(0.0, dot(normal, normalize(vec3(-0.18, 0.3, 0.94)))), 40.0);
    vec3 lit = color * (0.52 + 0.48 * light) * (0.62 + 0.38 * normal.z) + 0.14 * shine;
    float fade = depthCue * smoothstep(0.25, 0.95, depth);
    return mix(background, lit, kept * (1.0 - fade));
  }`;

// What is not selected (alpha 0) is drawn faint; kept says how much of it is left. What is hidden has
// half of alpha, and goes to a place that is never seen.
const keptOf = 'mix(0.12, 1.0, color.a)';
const hide = (isHidden) => `if (${isHidden}) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);`;
const hasHalf = (alpha) => `abs(${alpha} - 0.5) < 0.1`;

export const atoms = {
  vertexShader: `
    precision highp float;
    in vec3 position;
    in vec4 color;
    in float radius;
    uniform mat4 modelViewMatrix, projectionMatrix;
    uniform float pixelsPerUnit, radiusFactor, depthPerUnit;
    out vec3 tint;
    out float kept, depth, reach;
    void main() {
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      float shown = radius * radiusFactor * mix(0.6, 1.0, color.a);
      gl_PointSize = max(2.0 * shown * pixelsPerUnit, 1.5);
      tint = color.rgb;
      kept = ${keptOf};
      depth = gl_Position.z * 0.5 + 0.5;
      reach = shown * depthPerUnit;
      ${hide(hasHalf('color.a'))}
    }`,
  fragmentShader: `
    precision highp float;
    in vec3 tint;
    in float kept, depth, reach;
    out vec4 pixel;
    ${shading}
    void main() {
      vec2 at = vec2(gl_PointCoord.x, 1.0 - gl_PointCoord.y) * 2.0 - 1.0;
      float square = dot(at, at);
      if (square > 1.0) discard;
      float height = sqrt(1.0 - square);
      gl_FragDepth = depth - height * reach;
      pixel = vec4(shaded(tint, vec3(at, height), depth, kept), 1.0);
    }`,
};

export const bonds = {
  vertexShader: `
    precision highp float;
    in vec3 position;   // this end
    in vec3 other;      // the other end
    in vec2 corner;     // side of the axis, and which end it is
    in vec4 color, otherColor;
    uniform mat4 modelViewMatrix, projectionMatrix;
    uniform float bondRadius, depthPerUnit;
    out vec3 tint;
    out float kept, depth, reach, side;
    void main() {
      vec3 here = (modelViewMatrix * vec4(position, 1.0)).xyz;
      vec3 there = (modelViewMatrix * vec4(other, 1.0)).xyz;
      vec2 axis = (there.xy - here.xy) * corner.y;
      float size = length(axis);
      axis = size > 1e-6 ? axis / size : vec2(1.0, 0.0);
      here.xy += vec2(-axis.y, axis.x) * corner.x * bondRadius;
      gl_Position = projectionMatrix * vec4(here, 1.0);
      tint = color.rgb;
      kept = mix(0.12, 1.0, min(color.a, otherColor.a));
      depth = gl_Position.z * 0.5 + 0.5;
      reach = bondRadius * depthPerUnit;
      side = corner.x;
      ${hide(`${hasHalf('color.a')} || ${hasHalf('otherColor.a')}`)}
    }`,
  fragmentShader: `
    precision highp float;
    in vec3 tint;
    in float kept, depth, reach, side;
    out vec4 pixel;
    ${shading}
    void main() {
      float height = sqrt(max(0.0, 1.0 - side * side));
      gl_FragDepth = depth - height * reach;
      pixel = vec4(shaded(tint, vec3(0.0, side * 0.3, height), depth, kept), 1.0);
    }`,
};

export const rings = {
  vertexShader: `
    precision highp float;
    in vec3 position;
    in vec4 color;
    uniform mat4 modelViewMatrix, projectionMatrix;
    out vec3 tint, place;
    out float kept, depth;
    void main() {
      vec4 here = modelViewMatrix * vec4(position, 1.0);
      gl_Position = projectionMatrix * here;
      place = here.xyz;
      tint = color.rgb;
      kept = ${keptOf};
      depth = gl_Position.z * 0.5 + 0.5;
      ${hide(hasHalf('color.a'))}
    }`,
  fragmentShader: `
    precision highp float;
    in vec3 tint, place;
    in float kept, depth;
    out vec4 pixel;
    ${shading}
    void main() {
      vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
      normal *= normal.z < 0.0 ? -1.0 : 1.0;
      pixel = vec4(shaded(tint, normal, depth, kept), 1.0);
    }`,
};

export const ghost = {
  vertexShader: rings.vertexShader.replaceAll('in vec4 color;', '').replaceAll('color', 'vec4(1.0)'),
  fragmentShader: `
    precision highp float;
    in vec3 tint, place;
    in float kept, depth;
    uniform vec3 ghostColor;
    out vec4 pixel;
    void main() {
      vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
      pixel = vec4(ghostColor, mix(0.5, 0.06, abs(normal.z)));
    }`,
};

export const marker = {
  vertexShader: `
    precision highp float;
    in vec3 position;
    uniform mat4 modelViewMatrix, projectionMatrix;
    uniform float markerSize;
    void main() {
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_PointSize = markerSize;
    }`,
  fragmentShader: `
    precision highp float;
    uniform vec3 markerColor, background;
    uniform float markerSize;
    out vec4 pixel;
    void main() {
      float distance = length(gl_PointCoord * 2.0 - 1.0) * markerSize * 0.5;
      float rim = markerSize * 0.5 - distance;
      if (rim < 0.0 || rim > 7.0) discard;
      pixel = vec4(rim > 1.5 && rim < 5.5 ? markerColor : background, 1.0);
    }`,
};
