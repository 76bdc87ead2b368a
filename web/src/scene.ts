import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  EdgesGeometry,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Object3D,
  PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Body, Panel, Report, Shape } from './data';
import { element } from './dom';
import { indexAt, poseAt } from './motion';
import { cornersOf } from './outline';
import { roundStep } from './path_view';
import type { Player } from './player';
import { geometryOf, gridGeometry, reliefMesh } from './solids';
import { currentTheme, onThemeChange, seriesColour, type Theme } from './theme';

const CONTACT_SECONDS = 0.7; // for which a contact is shown
const MOST_TRAIL = 20000;
const LIVE_REACH = 60; // of the craft's size: how far the ground of a live run goes around it

/** Whether there is no graphics hardware, so that every pixel costs the processor's time. */
function drawsInSoftware(): boolean {
  const context = document.createElement('canvas').getContext('webgl');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  if (!context || !names) return false;
  const renderer = String(context.getParameter(names.UNMASKED_RENDERER_WEBGL));
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software/i.test(renderer);
}

interface Thrust {
  arrow: Mesh;
  full: number;
  panel: Panel;
  /** Of the curve of the engine in the panel. */
  curve: number;
}

interface Actor {
  body: Body;
  object: Group;
  thrusts: Thrust[];
  trail: Line | undefined;
  trailTimes: Float64Array;
}

/** The run in three dimensions. */
export class SceneView {
  readonly root = element('div', { class: 'view', role: 'img', 'aria-label': 'The run in three dimensions' });
  /** Pictures that were drawn. */
  frames = 0;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(45, 1, 0.01, 1e6);
  private readonly controls: OrbitControls;
  private readonly actors: Actor[] = [];
  private readonly contact = new Group();
  private readonly isSoftware: boolean;
  private readonly size: number; // m, of the greatest craft
  private followed: Actor | undefined;
  private isStale = true;
  /** A plane that goes with the craft: of a live run nobody knows how far it will go. */
  private roaming: { ground: Object3D; cell: number } | undefined;

  /** @param isLive motions and curves grow: see grow(). @throws Error where there is no WebGL. */
  constructor(
    private readonly report: Report,
    private readonly player: Player,
    private readonly isLive = false,
  ) {
    this.isSoftware = drawsInSoftware();
    this.renderer = new WebGLRenderer({ antialias: !this.isSoftware, powerPreference: 'high-performance' });
    this.root.append(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.maxPolarAngle = Math.PI * 0.499;
    this.controls.addEventListener('change', () => { this.isStale = true; });
    this.size = Math.max(0.2, ...report.runs.flatMap((run) => run.bodies).filter((body) => body.craft)
      .flatMap((body) => cornersOf(body.shapes).map(([x, y, z]) => 2 * Math.hypot(x, y, z))));
    this.build();
    this.follow(report.runs[0]?.bodies[0]);
    new ResizeObserver(() => { this.resize(); }).observe(this.root);
    onThemeChange(() => { this.build(); });
    player.onTime(() => { this.isStale = true; });
  }

  /** Gives back what the graphics hold: the view is not drawn any more. */
  dispose(): void {
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** The camera goes with a body, or stands where it is. */
  follow(body: Body | undefined): void {
    const isFirst = this.followed === undefined;
    this.followed = this.actors.find((actor) => actor.body === body);
    if (!this.followed) return;
    const { position } = poseAt(this.followed.body.motion, this.player.shown);
    const target = new Vector3(...position);
    const offset = isFirst
      ? new Vector3(-4.2, -3.4, 3.0).multiplyScalar(this.size)
      : this.camera.position.clone().sub(this.controls.target);
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(offset);
    this.isStale = true;
  }

  get isFollowing(): boolean {
    return this.followed !== undefined;
  }

  private build(): void {
    const theme = currentTheme();
    const followed = this.followed?.body;
    this.scene.clear();
    this.actors.length = 0;
    this.scene.background = new Color(theme.sky);
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(-3, -5, 9);
    this.scene.add(sun, new AmbientLight(0xffffff, theme.dark ? 1.2 : 1.6), this.groundOf(theme), this.contact);
    this.buildContact(theme.alarm);
    this.report.runs.forEach((run, runIndex) => {
      if (runIndex === 0) {
        for (const obstacle of run.obstacles) {
          for (const shape of obstacle.shapes) this.scene.add(this.solid(shape, theme.obstacle, 0.85));
        }
      }
      run.bodies.forEach((body, i) => {
        const colour = body.craft ? seriesColour(theme, i) : theme.body;
        this.addActor(body, colour, runIndex > 0);
      });
    });
    this.followed = this.actors.find((actor) => actor.body === followed);
    this.isStale = true;
  }

  /** The ground of the scenario; else a plane under what is lowest at the start. Lines at even distances. */
  private groundOf({ ground, lines }: Theme): Object3D {
    const described = this.report.runs[0]?.ground;
    if (described && described.columns > 0) return reliefMesh(described, ground, lines);
    const bodies = this.report.runs.flatMap((run) => run.bodies);
    const reach = Math.max((this.isLive ? LIVE_REACH : 10) * this.size, ...(this.isLive ? [] : bodies).flatMap(({ motion }) =>
      motion.position.slice(0, 2).map((column) => column.reduce((most, value) => Math.max(most, Math.abs(value)), 0))));
    const cell = roundStep(Math.max(1.2 * this.size, reach / 40));
    const cells = 2 * Math.ceil((1.6 * reach) / cell);
    const lowest = Math.min(0, ...bodies.map((body) =>
      (body.motion.position[2]?.[0] ?? 0) + Math.min(0, ...cornersOf(body.shapes).map(([, , z]) => z))));
    const grid = new LineSegments(gridGeometry(cells, cell), new LineBasicMaterial({ color: lines }));
    grid.position.z = 0.002 * this.size;
    const plane = new Mesh(new PlaneGeometry(cells * cell, cells * cell), new MeshBasicMaterial({ color: ground }));
    const made = new Group();
    made.add(plane, grid);
    made.position.z = described ? described.height : lowest - 0.01 * this.size;
    if (described) made.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...described.normal));
    this.roaming = this.isLive && (!described || described.normal[2] === 1) ? { ground: made, cell } : undefined;
    return made;
  }

  private solid(shape: Shape, colour: string, opacity: number): Object3D {
    const geometry = geometryOf(shape);
    const material = new MeshLambertMaterial({
      color: colour,
      transparent: opacity < 1,
      opacity,
      side: DoubleSide,
      flatShading: shape.kind === 'faces',
    });
    const mesh = new Mesh(geometry, material);
    const edges = new LineSegments(
      new EdgesGeometry(geometry, 30),
      new LineBasicMaterial({ color: new Color(colour).multiplyScalar(0.55), transparent: opacity < 1, opacity }),
    );
    mesh.add(edges);
    mesh.position.set(...shape.position);
    mesh.quaternion.copy(new Quaternion(...shape.orientation));
    return mesh;
  }

  private addActor(body: Body, colour: string, isOther: boolean): void {
    const object = new Group();
    const opacity = isOther ? 0.35 : 1;
    for (const shape of body.shapes) {
      object.add(this.solid(shape, shape.role === 'skirt' ? currentTheme().skirt : colour, opacity));
    }
    if (body.shapes.length === 0) object.add(this.pointer(colour));
    else if (body.craft) object.add(this.bowOf(body));
    const thrusts = isOther ? [] : this.addEngines(body, object);
    const trail = this.trailOf(body, colour, isOther);
    this.scene.add(object, trail.line);
    this.actors.push({ body, object, thrusts, trail: trail.line, trailTimes: trail.times });
  }

  /** A body of which nothing is known but where it is. */
  private pointer(colour: string): Object3D {
    const cone = new ConeGeometry(0.1 * this.size, 0.5 * this.size, 24).rotateZ(-Math.PI / 2);
    return new Mesh(cone, new MeshLambertMaterial({ color: colour }));
  }

  /** A bright wedge on the deck that points forwards, so that fore and aft are told apart. */
  private bowOf(body: Body): Object3D {
    const corners = cornersOf(body.shapes);
    const front = Math.max(...corners.map(([x]) => x));
    const top = Math.max(...corners.map(([, , z]) => z));
    const length = 0.16 * this.size;
    const wedge = new CylinderGeometry(0.6 * length, 0.6 * length, 0.012 * this.size, 3).rotateX(Math.PI / 2).rotateZ(Math.PI / 2);
    const mesh = new Mesh(wedge, new MeshLambertMaterial({ color: '#ffffff' }));
    mesh.position.set(front - length, 0, top);
    return mesh;
  }

  private addEngines(body: Body, object: Group): Thrust[] {
    const panel = body.panels.find((each) => each.main && each.unit === 'N');
    const thrusts: Thrust[] = [];
    const theme = currentTheme();
    for (const engine of body.engines) {
      const along = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...engine.direction));
      const radius = 0.09 * this.size;
      const fan = new Mesh(
        new CylinderGeometry(radius, radius, 0.1 * this.size, 24, 1, true),
        new MeshLambertMaterial({ color: theme.dark ? '#8b97a5' : '#3c4650', side: DoubleSide }),
      );
      fan.quaternion.copy(along);
      fan.position.set(...engine.position);
      object.add(fan);
      const curve = panel?.curves().findIndex((each) => each.label === engine.name && !each.demand) ?? -1;
      if (!panel || curve < 0) continue;
      // From 0 to 1 along y: scaled by the thrust.
      const geometry = new ConeGeometry(0.045 * this.size, 1, 16).translate(0, 0.5, 0);
      const arrow = new Mesh(geometry, new MeshLambertMaterial({ color: '#e69f00' }));
      arrow.position.set(...engine.position);
      arrow.quaternion.copy(along);
      object.add(arrow);
      thrusts.push({ arrow, full: engine.full, panel, curve });
    }
    return thrusts;
  }

  private trailOf({ motion }: Body, colour: string, isOther: boolean): { line: Line; times: Float64Array } {
    const count = motion.times.length;
    const stride = Math.max(1, Math.ceil(count / MOST_TRAIL));
    const shown = Math.ceil(count / stride);
    const points = new Float32Array(3 * shown);
    const times = new Float64Array(shown);
    for (let i = 0; i < shown; ++i) {
      times[i] = motion.times[i * stride];
      for (let axis = 0; axis < 3; ++axis) points[3 * i + axis] = motion.position[axis]?.[i * stride] ?? 0;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    const line = new Line(geometry, new LineBasicMaterial({ color: colour, transparent: isOther, opacity: isOther ? 0.5 : 1 }));
    line.frustumCulled = false;
    return { line, times };
  }

  private buildContact(colour: string): void {
    this.contact.clear();
    const material = new MeshLambertMaterial({ color: colour, emissive: colour, emissiveIntensity: 0.5 });
    const ball = new Mesh(new SphereGeometry(0.05 * this.size, 16, 12), material);
    const arrow = new Mesh(new ConeGeometry(0.03 * this.size, 0.5 * this.size, 12).translate(0, 0.25 * this.size, 0), material);
    this.contact.add(ball, arrow);
    this.contact.visible = false;
  }

  private resize(): void {
    const width = this.root.clientWidth || 1;
    const height = this.root.clientHeight || 1;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, this.isSoftware ? 1 : 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.isStale = true;
  }

  /** Draws what changed since the last time. */
  draw(): void {
    if (!this.isStale) return;
    this.isStale = false;
    const time = this.player.shown;
    for (const actor of this.actors) this.place(actor, time);
    this.showContact(time);
    this.controls.update();
    this.renderer.render(this.scene, this.camera);
    this.isStale = false; // what the controls said while they followed
    ++this.frames;
  }

  private place(actor: Actor, time: number): void {
    const { position, orientation } = poseAt(actor.body.motion, time);
    actor.object.position.set(...position);
    actor.object.quaternion.set(...orientation);
    for (const { arrow, full, panel, curve } of actor.thrusts) {
      const share = (panel.curves()[curve]?.values[indexAt(panel.times(), time)] ?? 0) / full;
      arrow.visible = Math.abs(share) > 0.01;
      if (arrow.visible) arrow.scale.set(1, share * 0.9 * this.size, 1);
    }
    actor.trail?.geometry.setDrawRange(0, indexAt(actor.trailTimes, time) + 1);
    if (actor !== this.followed) return;
    const target = new Vector3(...position);
    this.camera.position.add(target.clone().sub(this.controls.target));
    this.controls.target.copy(target);
    if (!this.roaming) return;
    const { ground, cell } = this.roaming;
    ground.position.setX(Math.round(target.x / cell) * cell).setY(Math.round(target.y / cell) * cell);
  }

  /** Draws the ways anew as far as they go by now. */
  grow(): void {
    for (const actor of this.actors) {
      if (!actor.trail) continue;
      const { line, times } = this.trailOf(actor.body, '#000000', false);
      actor.trail.geometry.dispose();
      actor.trail.geometry = line.geometry;
      (line.material as LineBasicMaterial).dispose();
      actor.trailTimes = times;
    }
    this.isStale = true;
  }

  private showContact(time: number): void {
    const contacts = this.report.runs[0]?.contacts ?? [];
    const contact = contacts.length > 0 ? contacts[indexAt(this.contactTimes, time)] : undefined;
    this.contact.visible = contact !== undefined && time >= contact.time && time - contact.time < CONTACT_SECONDS;
    if (!contact || !this.contact.visible) return;
    this.contact.position.set(...contact.point);
    this.contact.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...contact.normal).normalize());
  }

  private get contactTimes(): number[] {
    return (this.times ??= this.report.runs[0]?.contacts.map(({ time }) => time) ?? []);
  }
  private times: number[] | undefined;
}
