'use strict';
// The terrain in CesiumJS: its levels one at a time or as a client streams them, lines over it, and
// where the camera stands. Nothing comes from outside: no imagery, no terrain, no account.
(() => {
  const loadScript = (url) => new Promise((done, fail) => {
    const script = Object.assign(document.createElement('script'), { src: url });
    script.addEventListener('load', done);
    script.addEventListener('error', () => fail(new Error(`${url} cannot be loaded`)));
    document.head.append(script);
  });
  const loadCesium = async (folder) => {
    document.head.append(Object.assign(document.createElement('link'),
      { rel: 'stylesheet', href: `${folder}/Widgets/CesiumWidget/CesiumWidget.css` }));
    await loadScript(`${folder}/Cesium.js`);
    if (!globalThis.Cesium) {
      throw new Error(
        `${folder}/Cesium.js does not run here; let service/pages/install-cesium make it`);
    }
    return globalThis.Cesium;
  };

  const matrixOf = (C, tile, above) => (tile.transform
    ? C.Matrix4.multiply(above, C.Matrix4.fromArray(tile.transform), new C.Matrix4()) : above);
  // Contents of a tileset by level, finest first, with the transforms above them. A level is all
  // contents, of however many tiles, whose names begin with lodN.
  const levelsOf = (C, tileset) => {
    const levels = new Map();
    const open = [{ tile: tileset.root, above: C.Matrix4.IDENTITY }];
    while (open.length) {
      const { tile, above } = open.pop();
      const matrix = matrixOf(C, tile, above);
      for (const { uri } of [...(tile.content ? [tile.content] : []), ...(tile.contents ?? [])]) {
        const level = Number(/(?:^|\/)lod(\d+)[^/]*\.glb$/.exec(uri)?.[1] ?? NaN);
        if (Number.isNaN(level)) continue;
        levels.set(level, [...(levels.get(level) ?? []), { uri, matrix }]);
      }
      for (const child of tile.children ?? []) open.push({ tile: child, above: matrix });
    }
    return new Map([...levels].sort(([a], [b]) => a - b));
  };

  class Scene {
    static async open(container, credits, { results, cesium, sky, ground }) {
      const C = await loadCesium(cesium);
      const url = new URL('tileset.json', new URL(results || '.', location.href)).href;
      const response = await farhorizon.key.get(url);
      if (!response.ok) throw new Error(`tileset.json: ${response.status}`);
      const scene = new Scene();
      Object.assign(scene, {
        C, url, failures: [], lines: null, models: new Map(), shown: 'stream',
      });
      const tileset = await response.json();
      scene.levels = levelsOf(C, tileset);
      scene.frame = matrixOf(C, tileset.root, C.Matrix4.IDENTITY); // lines lie in it, too
      scene.makeWidget(container, credits);
      scene.setColours(sky, ground);
      await scene.addTileset();
      scene.fit();
      return scene;
    }

    makeWidget(container, credits) {
      const { C } = this;
      C.Ion.defaultAccessToken = undefined;
      C.CreditDisplay.cesiumCredit = new C.Credit('CesiumJS', true); // in place of its ion's
      this.widget = new C.CesiumWidget(container, {
        baseLayer: false, terrainProvider: new C.EllipsoidTerrainProvider(), scene3DOnly: true,
        skyBox: false, skyAtmosphere: false, creditContainer: credits, requestRenderMode: true,
        maximumRenderTimeChange: Infinity, useBrowserRecommendedResolution: true,
      });
      const { scene } = this.widget;
      scene.fog.enabled = false;
      scene.globe.showGroundAtmosphere = false;
      for (const body of [scene.sun, scene.moon]) if (body) body.show = false;
      // A skyline is looked at from afar, and a camera may stand anywhere.
      scene.screenSpaceCameraController.enableCollisionDetection = false;
      scene.renderError.addEventListener((_, failure) => this.failures.push(String(failure)));
      new ResizeObserver(() => this.keepWidth()).observe(container);
      this.keepWidth();
    }
    // The same 60 degrees over the picture's width, however high it is: CesiumJS gives its field of
    // view to the longer side, which on a phone is a matter of whether the panel is folded.
    keepWidth() {
      const { clientWidth, clientHeight } = this.widget.canvas;
      const half = Math.tan(this.C.Math.toRadians(30));
      this.widget.camera.frustum.fov = 2 * Math.atan(half * Math.max(1, clientHeight / clientWidth));
      this.draw();
    }

    async addTileset() {
      const { C } = this;
      // What the README tells clients to set.
      this.tileset = await C.Cesium3DTileset.fromUrl(this.resource(this.url), {
        maximumScreenSpaceError: 2, dynamicScreenSpaceError: false, enableDebugWireframe: true,
      });
      this.tileset.tileFailed.addEventListener(({ url, message }) => {
        this.failures.push(`${url}: ${message}`);
      });
      this.widget.scene.primitives.add(this.tileset);
      this.sphere = this.tileset.boundingSphere;
      // From the north-west, as on maps.
      const light = C.Matrix4.multiplyByPointAsVector(
        C.Transforms.eastNorthUpToFixedFrame(this.sphere.center),
        new C.Cartesian3(0.55, -0.55, -0.62), new C.Cartesian3());
      this.widget.scene.light = new C.DirectionalLight(
        { direction: C.Cartesian3.normalize(light, light), intensity: 2.4 });
    }

    setColours(sky, ground) {
      const { scene } = this.widget;
      this.sky = this.C.Color.fromCssColorString(sky);
      scene.backgroundColor = this.sky;
      scene.globe.baseColor = this.C.Color.fromCssColorString(ground);
      this.draw();
    }

    // What CesiumJS is to fetch, with the key; what it fetches from there has it, too.
    resource(url) { return new this.C.Resource({ url, headers: farhorizon.key.headers() }); }

    draw() { this.widget.scene.requestRender(); }

    // A content as a model by itself, hidden, once it can be drawn.
    async load({ uri, matrix }) {
      const { C } = this;
      const { primitives } = this.widget.scene;
      const model = primitives.add(await C.Model.fromGltfAsync({
        url: this.resource(new URL(uri, this.url).href), modelMatrix: matrix, forwardAxis: C.Axis.X, show: false,
        enableDebugWireframe: true,
      }));
      try {
        await new Promise((done, fail) => {
          model.readyEvent.addEventListener(done);
          model.errorEvent.addEventListener(fail);
          this.draw();
        });
      } catch (failure) {
        primitives.remove(model);
        throw failure;
      }
      return model;
    }
    // All models of a level, hidden, once all of them are there. Where one fails none stays, so that
    // the level can be asked for again.
    modelsOf(level) {
      if (!this.models.has(level)) {
        const models = this.loadAll(level);
        this.models.set(level, models);
        models.catch(() => this.models.delete(level));
      }
      return this.models.get(level);
    }
    async loadAll(level) {
      const loads = await Promise.allSettled(this.levels.get(level).map((one) => this.load(one)));
      const failed = loads.find(({ status }) => status === 'rejected');
      if (!failed) return loads.map(({ value }) => value);
      for (const { value } of loads) if (value) this.widget.scene.primitives.remove(value);
      throw failed.reason;
    }

    // level: a number, or 'stream': the tileset as a client draws it.
    async show(level) {
      this.shown = level;
      const models = level === 'stream' ? [] : await this.modelsOf(level);
      if (this.shown !== level) return; // another has been asked for meanwhile
      await this.only(models, level === 'stream');
      this.draw();
    }
    async only(models, stream) {
      this.tileset.show = stream;
      for (const one of (await Promise.all([...this.models.values()])).flat()) {
        one.show = models.includes(one);
      }
    }

    async drawn() {
      return [this.tileset, ...(await Promise.all([...this.models.values()])).flat()];
    }
    async setWireframe(on) {
      for (const one of await this.drawn()) one.debugWireframe = on;
      this.draw();
    }
    async setInlineEdges(on) {
      const mode = on ? 'SURFACES_AND_EDGES' : 'SURFACES_ONLY';
      for (const one of await this.drawn()) one.edgeDisplayMode = this.C.EdgeDisplayMode[mode];
      this.draw();
    }

    setLines(primitive) {
      const { primitives } = this.widget.scene;
      if (this.lines) primitives.remove(this.lines);
      this.lines = primitive && primitives.add(primitive);
      this.draw();
    }

    // From the south, half above.
    fit() {
      this.orbit = { heading: 0, pitch: -40, range: 1.75 * this.sphere.radius };
      this.place();
    }
    // From outside the tile, nearly level, as its skyline is seen from afar.
    look(azimuth) {
      this.orbit = { heading: azimuth, pitch: -2, range: 1.3 * this.sphere.radius };
      this.place();
    }
    turn({ heading = 0, pitch = 0, zoom = 1 }) {
      this.orbit.heading = (this.orbit.heading + heading + 360) % 360;
      this.orbit.pitch = Math.min(0, Math.max(-89, this.orbit.pitch + pitch));
      this.orbit.range = Math.max(0.05 * this.sphere.radius, this.orbit.range * zoom);
      this.place();
    }
    place() {
      const { C } = this;
      const { heading, pitch, range } = this.orbit;
      const rad = C.Math.toRadians;
      this.widget.camera.lookAt(
        this.sphere.center, new C.HeadingPitchRange(rad(heading), rad(pitch), range));
      this.widget.camera.lookAtTransform(C.Matrix4.IDENTITY);
      this.draw();
    }

    // The skyline of a level from where the camera stands, a row for each column.
    async skylineOf(level) {
      const models = await this.modelsOf(level);
      const { scene, canvas } = this.widget;
      const shown = (await this.drawn()).filter((one) => one.show);
      await this.only(models, false);
      const lines = this.lines?.show;
      if (this.lines) this.lines.show = false;
      scene.globe.show = false;
      const rows = farhorizon.skyline.read(canvas, (sky) => {
        scene.backgroundColor = this.C.Color.fromBytes(...sky);
        // The first picture after a change of what is shown lacks it.
        for (let i = 0; i < 2; ++i) {
          scene.requestRender();
          scene.render();
        }
      });
      scene.backgroundColor = this.sky;
      scene.globe.show = true;
      if (this.lines) this.lines.show = lines;
      for (const one of await this.drawn()) one.show = shown.includes(one);
      this.draw();
      return rows;
    }
  }

  farhorizon.Scene = Scene;
})();
