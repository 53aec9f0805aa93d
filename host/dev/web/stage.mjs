// A picture on a canvas: the user zooms it, moves it, and points at single pixels.

export class Stage {
  // `on`: { hover([x, y] or null), click([x, y]), drag(dx, dy), wheel(steps) }; drag and wheel return whether
  // they took the gesture; if not, it moves or zooms the picture.
  constructor(canvas, on) {
    this.canvas = canvas;
    this.on = on;
    this.image = null;      // an ImageBitmap
    this.size = [0, 0];     // size of the picture, in pixels
    this.marked = null;     // a pixel
    this.scale = 1;
    this.x = this.y = 0;    // the position of the picture's corner, in CSS pixels
    this.held = null;
    canvas.addEventListener('wheel', event => this.#wheel(event), { passive: false });
    canvas.addEventListener('pointerdown', event => this.#down(event));
    canvas.addEventListener('pointermove', event => this.#move(event));
    canvas.addEventListener('pointerup', event => this.#up(event));
    canvas.addEventListener('pointerleave', () => this.on.hover(null));
    new ResizeObserver(() => { if (this.fitted) this.fit(); else this.draw(); }).observe(canvas);
  }

  show(image) {
    const resized = this.size[0] !== image.width || this.size[1] !== image.height;
    this.image?.close();
    this.image = image;
    this.size = [image.width, image.height];
    this.canvas.style.setProperty('--shape', image.width / image.height);
    if (resized) this.fit();
    else this.draw();
  }

  fit() {
    const box = this.canvas.getBoundingClientRect(), [width, height] = this.size;
    this.scale = Math.min(box.width / Math.max(width, 1), box.height / Math.max(height, 1));
    this.x = (box.width - width * this.scale) / 2;
    this.y = (box.height - height * this.scale) / 2;
    this.fitted = true;
    this.draw();
  }

  // Zooms about the point `at` of the canvas, or about its middle.
  zoom(factor, at) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = at ?? [box.width / 2, box.height / 2];
    const scale = Math.min(Math.max(this.scale * factor, 0.05), 200);
    this.x = x - (x - this.x) * scale / this.scale;
    this.y = y - (y - this.y) * scale / this.scale;
    this.scale = scale;
    this.fitted = false;
    this.draw();
  }

  draw() {
    const box = this.canvas.getBoundingClientRect(), ratio = devicePixelRatio || 1;
    this.canvas.width = Math.round(box.width * ratio);
    this.canvas.height = Math.round(box.height * ratio);
    if (!this.image) return;
    const context = this.canvas.getContext('2d');
    context.setTransform(ratio * this.scale, 0, 0, ratio * this.scale, ratio * this.x, ratio * this.y);
    context.imageSmoothingEnabled = this.scale < 1;
    context.drawImage(this.image, 0, 0);
    if (!this.marked) return;
    context.lineWidth = 1.5 / this.scale;
    context.strokeStyle = '#00e5ff';
    context.strokeRect(this.marked[0], this.marked[1], 1, 1);
  }

  pixel_at(event) {
    const x = Math.floor((event.offsetX - this.x) / this.scale), y = Math.floor((event.offsetY - this.y) / this.scale);
    return x >= 0 && y >= 0 && x < this.size[0] && y < this.size[1] ? [x, y] : null;
  }

  #wheel(event) {
    event.preventDefault();
    const steps = -event.deltaY / 240;
    if (!this.on.wheel(steps)) this.zoom(2 ** steps, [event.offsetX, event.offsetY]);
  }
  #down(event) {
    this.held = { x: event.offsetX, y: event.offsetY, moved: false };
    this.canvas.setPointerCapture(event.pointerId);
  }
  #move(event) {
    if (!this.held) return this.on.hover(this.pixel_at(event));
    const dx = event.offsetX - this.held.x, dy = event.offsetY - this.held.y;
    if (!this.held.moved && Math.hypot(dx, dy) <= 3) return;
    this.held = { x: event.offsetX, y: event.offsetY, moved: true };
    if (this.on.drag(dx, dy)) return;
    this.x += dx;
    this.y += dy;
    this.fitted = false;
    this.draw();
  }
  #up(event) {
    const clicked = this.held && !this.held.moved ? this.pixel_at(event) : null;
    this.held = null;
    if (clicked) this.on.click(clicked);
  }
}
