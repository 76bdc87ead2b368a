import { BoxGeometry, BufferAttribute, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DoubleSide, Mesh, MeshBasicMaterial, Object3D, SphereGeometry } from 'three';
import type { Ground, Shape } from './data';
import { levelShade, reliefOf, shadesOf } from './relief';

/** The geometry of a shape, in its own frame. */
export function geometryOf(shape: Shape): BufferGeometry {
  const [a, b, c] = shape.size;
  switch (shape.kind) {
    case 'box':
      return new BoxGeometry(a, b, c);
    case 'cylinder': // along y in three.js
      return new CylinderGeometry(a, a, b, 32).rotateX(Math.PI / 2);
    case 'cone':
      return new ConeGeometry(a, b, 32).rotateX(Math.PI / 2);
    case 'sphere':
      return new SphereGeometry(a, 32, 16);
    case 'faces':
      return facesOf(shape);
  }
}

function facesOf({ vertices = [], faces = [] }: Shape): BufferGeometry {
  const corners = faces.flatMap((face) =>
    face.slice(2).flatMap((_, i) => [face[0], face[i + 1], face[i + 2]].flatMap((at) => vertices[at ?? 0] ?? [0, 0, 0])),
  );
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(corners), 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** A net of lines in pieces of a cell: renderers without hardware lose a line that begins behind the camera. */
export function gridGeometry(cells: number, cell: number): BufferGeometry {
  const points: number[] = [];
  const half = (cells * cell) / 2;
  for (let i = 0; i <= cells; ++i) {
    for (let j = 0; j < cells; ++j) {
      const [across, from, to] = [i * cell - half, j * cell - half, (j + 1) * cell - half];
      points.push(across, from, 0, across, to, 0, from, across, 0, to, across, 0);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  return geometry;
}

export function reliefMesh(ground: Ground, colour: string, lines: string): Object3D {
  const { corners, triangles } = reliefOf(ground);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(corners, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  const light = new Color(colour);
  const dark = new Color(lines);
  const colours = new Float32Array(corners.length);
  // Twice as far from level as they are: slopes that matter to a craft are gentle.
  shadesOf(ground).forEach((shade, i) => {
    light.clone().lerp(dark, Math.min(1, Math.max(0, 0.3 + 4 * (levelShade - shade / 255)))).toArray(colours, 3 * i);
  });
  geometry.setAttribute('color', new BufferAttribute(colours, 3));
  return new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
}
