// SPDX-License-Identifier: Apache-2.0
// The solid objects: the city by material, the vehicles of a frame, edges that diffract.
// Triangles are shaded flat, and look the same from both sides; outlines are the edges of houses.
"use strict";

const finite = (column, i) => Number.isFinite(column[3 * i] + column[3 * i + 1] + column[3 * i + 2]);

// Returns the corners of the triangles of a scene by the name of their material, with flat roofs separate; a triangle
// with a damaged index is left out. Rows are [name, is roof, corners].
function corners_by_material(scene) {
  const lists = new Map(), roofs = roof_triangles(scene);
  for (let t = 0; t < scene.triangle_surface.length; ++t) {
    const name = scene.materials[scene.surface_material[scene.triangle_surface[t]]] || "unknown", key = roofs[t] + name;
    if (!lists.has(key)) lists.set(key, []);
    lists.get(key).push(t);
  }
  const corners = [];
  for (const [key, triangles] of lists) {
    const positions = new Float32Array(9 * triangles.length);
    triangles.forEach((t, k) => {
      for (let corner = 0; corner < 3; ++corner) {
        const vertex = scene.triangles[3 * t + corner];
        positions.set(scene.vertices.subarray(3 * vertex, 3 * vertex + 3), 9 * k + 3 * corner);
      }
    });
    corners.push([key.slice(1), key[0] === "1", positions]);
  }
  return corners;
}

function geometry_of(positions) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  return geometry;
}

function solid(positions, colour) {
  const geometry = geometry_of(positions);
  geometry.computeVertexNormals();  // without an index, each triangle gets its own normal
  const material = new THREE.MeshLambertMaterial({
    color: colour, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
  return new THREE.Mesh(geometry, material);
}

function outlines_of(scene) {
  const positions = new Float32Array(3 * scene.outlines.length);
  scene.outlines.forEach((vertex, k) => positions.set(scene.vertices.subarray(3 * vertex, 3 * vertex + 3), 3 * k));
  return geometry_of(positions);
}

function edges_of(scene) {
  const shown = [];
  scene.wedge_shown.forEach((wanted, k) => { if (wanted) shown.push(...scene.wedges.subarray(6 * k, 6 * k + 6)); });
  return geometry_of(new Float32Array(shown));
}

// Makes flat bands, in front of the ground below them.
function street_mesh() {
  const geometry = geometry_of(streets.vertices);
  geometry.setIndex(new THREE.BufferAttribute(streets.triangles, 1));
  geometry.computeVertexNormals();
  return new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({side: THREE.DoubleSide}));
}

// Makes crowns and woods, which are transparent: they hide nothing, and paths lie on top of them.
function vegetation_mesh(positions) {
  const geometry = geometry_of(positions);
  geometry.computeVertexNormals();
  const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({
    side: THREE.DoubleSide, transparent: true, opacity: vegetation_opacity, depthWrite: false,
  }));
  mesh.renderOrder = 1;
  return mesh;
}

class WorldView {
  constructor() {
    this.scene = new THREE.Scene();
    this.city = new THREE.Group();
    this.streets = street_mesh();
    this.vehicles = new THREE.Group();
    this.edges = new THREE.Group();
    this.edges.visible = false;
    this.vegetation = new THREE.Group();
    for (const [, positions] of vegetation) this.vegetation.add(vegetation_mesh(positions));
    this.scene.add(this.city, this.streets, this.vehicles, this.edges, this.vegetation);
    this.solids = [];  // [mesh, name of its material, whether it is of flat roofs]
    for (const [name, roof, positions] of corners_by_material(city)) {
      const mesh = solid(positions, "#ffffff");
      this.solids.push([mesh, name, roof]);
      this.city.add(mesh);
    }
    this.outline_material = new THREE.LineBasicMaterial({transparent: true, opacity: 0.55});
    this.city.add(new THREE.LineSegments(outlines_of(city), this.outline_material));
    this.edge_material = new THREE.LineBasicMaterial();
    this.edges.add(new THREE.LineSegments(edges_of(city), this.edge_material));
    this.ambient = new THREE.HemisphereLight(0xffffff, 0x8f8f8f, 0.75);
    this.ambient.position.set(0, 0, 1);
    this.sun = new THREE.DirectionalLight(0xffffff, 0.45);
    this.sun.position.set(-0.5, -0.8, 1.2);
    this.scene.add(this.ambient, this.sun);
    this.vehicle_material = new THREE.MeshLambertMaterial({side: THREE.DoubleSide});
    this.bodies = models.map((model) => {
      const all = corners_by_material(model).map(([, , positions]) => positions);
      const positions = new Float32Array(all.reduce((sum, part) => sum + part.length, 0));
      all.reduce((at, part) => (positions.set(part, at), at + part.length), 0);
      const geometry = geometry_of(positions);
      geometry.computeVertexNormals();
      return [geometry, outlines_of(model)];
    });
    // The box stands for a vehicle whose model is unknown.
    const box = new THREE.BoxBufferGeometry(4.5, 1.8, 1.5);
    box.translate(0, 0, 0.75);
    this.unknown_body = [box, new THREE.EdgesGeometry(box)];
    this.instances = new Map();  // vehicles that were present so far
    this.paint();
  }

  // Must be called after the colour scheme has changed.
  paint() {
    this.scene.background = new THREE.Color(theme().sky);
    for (const [mesh, name, roof] of this.solids) {
      mesh.material.color.set(material_colour(name));
      if (roof) mesh.material.color.lerp(new THREE.Color(roof_tint), roof_share);
      mesh.material.color.multiplyScalar(theme().city_light);
    }
    this.streets.material.color.set(street_colour).multiplyScalar(theme().city_light);
    this.vegetation.children.forEach((mesh, number) => mesh.material.color.set(vegetation_colour(number)));
    this.outline_material.color.set(theme().outline);
    this.edge_material.color.set(theme().wedge);
    this.vehicle_material.color.set(theme().vehicle);
  }

  instance(number) {
    if (!this.instances.has(number)) {
      const [body, outline] = this.bodies[meta.instances[number][2]] || this.unknown_body;
      const vehicle = new THREE.Mesh(body, this.vehicle_material);
      vehicle.add(new THREE.LineSegments(outline, this.outline_material));
      this.instances.set(number, vehicle);
      this.vehicles.add(vehicle);
    }
    return this.instances.get(number);
  }

  place(frame) {
    for (const vehicle of this.instances.values()) vehicle.visible = false;
    for (let k = 0; k < frame.poses; ++k) {
      if (!finite(frame.pose_m, k)) continue;
      const vehicle = this.instance(frame.pose_instance[k]);
      vehicle.visible = true;
      vehicle.position.fromArray(frame.pose_m, 3 * k);
      vehicle.quaternion.fromArray(frame.pose_rotation, 4 * k).normalize();
    }
  }
}

// Returns the surface of city or vehicles that the ray meets first: {point, distance}, or null.
function surface_under(world, raycaster) {
  const meshes = world.solids.map(([mesh]) => mesh).concat([...world.instances.values()].filter(({visible}) => visible));
  return raycaster.intersectObjects(meshes)[0] || null;
}

// Returns the box around ends and vehicles in all frames of the page, arrays of three; with_city: and around the city.
function box_of_run(with_city) {
  const lower = [Infinity, Infinity, Infinity], upper = [-Infinity, -Infinity, -Infinity];
  const grow = (column) => {
    for (let i = 0; 3 * i < column.length; ++i)
      if (finite(column, i))
        for (let axis = 0; axis < 3; ++axis) {
          lower[axis] = Math.min(lower[axis], column[3 * i + axis]);
          upper[axis] = Math.max(upper[axis], column[3 * i + axis]);
        }
  };
  if (meta.ends_m) for (const corner of meta.ends_m) grow(corner);
  if (with_city || lower[0] > upper[0]) {
    grow(city.vertices);
    for (const [, positions] of vegetation) grow(positions);
  }
  if (lower[0] > upper[0]) return [[-10, -10, 0], [10, 10, 5]];
  return [lower, upper];
}
