'use strict';
(() => {
  const $ = (id) => document.getElementById(id);
  const data = JSON.parse($('replay-facts').textContent);
  const canvas = $('floor');
  const slider = $('moment');
  const play = $('play');
  const css = getComputedStyle(document.documentElement);
  const color = (name) => css.getPropertyValue(name).trim();
  const ink = { plate: color('--floor-plate'), grid: color('--floor-grid'), edge: color('--floor-edge'), body: color('--floor-body'), rim: color('--floor-rim'), care: color('--floor-care'), line: color('--floor-ink-2'), area: color('--floor-obstacle') };
  let at = 0;
  let speed = 1;
  let running = false;
  let last = 0;

  /** The robots' samples: times in hundredths of a second, places in millimetres. None until they are unpacked. */
  let robots = [];
  /** Unpacks the numbers of all robots. crates/report/src/packed.rs describes their order and coding. */
  const unpack = async () => {
    const text = atob($('replay-numbers').textContent);
    const packed = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i += 1) packed[i] = text.charCodeAt(i);
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    let read = 0;
    const next = () => {
      let [number, weight, byte] = [0, 1, 0];
      do {
        byte = bytes[read];
        read += 1;
        number += (byte & 127) * weight;
        weight *= 128;
      } while (byte > 127);
      return number % 2 === 0 ? number / 2 : -(number + 1) / 2;
    };
    const lists = (at, width, summed) => {
      const made = data.tracks.map((track) => new Float64Array(track[at] * width));
      for (let column = 0; column < width; column += 1) {
        for (const list of made) {
          let sum = 0;
          for (let i = column; i < list.length; i += width) {
            sum = next() + (column < summed ? sum : 0);
            list[i] = sum;
          }
        }
      }
      return made;
    };
    const [planned, driven, light] = [lists(0, 3, 3), lists(1, 3, 3), lists(2, 2, 1)];
    robots = data.tracks.map((track, i) => ({ planned: planned[i], driven: driven[i], light: light[i], lost: track[3] }));
    paint();
  };

  /** Index of the last sample at or before `time`, by halving; 0 if all samples are later. */
  const before = (samples, width, time) => {
    let low = 0;
    let high = samples.length / width - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (samples[middle * width] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  };
  const place = (samples, time) => {
    if (samples.length === 0) return null;
    const i = before(samples, 3, time) * 3;
    const next = Math.min(i + 3, samples.length - 3);
    const whole = samples[next] - samples[i];
    const share = whole > 0 ? Math.min(1, Math.max(0, (time - samples[i]) / whole)) : 0;
    return [samples[i + 1] + (samples[next + 1] - samples[i + 1]) * share, samples[i + 2] + (samples[next + 2] - samples[i + 2]) * share];
  };
  const lightAt = (light, time) => (light.length === 0 || light[0] > time ? 0 : light[before(light, 2, time) * 2 + 1]);

  /** Draws the path from the time `from` to the time `until` as a line. Times are in hundredths of a second. */
  const trail = (draw, to, samples, from, until) => {
    if (samples.length < 6) return;
    draw.beginPath();
    draw.moveTo(...to(place(samples, from)));
    for (let i = before(samples, 3, from) * 3 + 3; i < samples.length && samples[i] < until; i += 3) {
      if (samples[i] > from) draw.lineTo(...to([samples[i + 1], samples[i + 2]]));
    }
    draw.lineTo(...to(place(samples, until)));
    draw.stroke();
  };

  const paint = () => {
    const scale = window.devicePixelRatio || 1;
    const wide = canvas.clientWidth;
    const high = canvas.clientHeight;
    canvas.width = Math.round(wide * scale);
    canvas.height = Math.round(high * scale);
    const draw = canvas.getContext('2d');
    draw.scale(scale, scale);
    const [width, depth] = data.floor.map((metres) => metres * 1000);
    const pixels = Math.min((wide - 32) / width, (high - 32) / depth);
    const to = ([x, y]) => [wide / 2 + x * pixels, high / 2 - y * pixels];
    const [left, top] = to([-width / 2, depth / 2]);
    draw.fillStyle = ink.plate;
    draw.fillRect(left, top, width * pixels, depth * pixels);
    draw.strokeStyle = ink.grid;
    const grid = Math.max(500, 500 * Math.ceil(Math.max(width, depth) / 20000));
    for (let x = Math.ceil(-width / 2 / grid) * grid; x < width / 2; x += grid) line(draw, to([x, -depth / 2]), to([x, depth / 2]));
    for (let y = Math.ceil(-depth / 2 / grid) * grid; y < depth / 2; y += grid) line(draw, to([-width / 2, y]), to([width / 2, y]));
    draw.fillStyle = ink.area;
    for (const area of data.areas) {
      const [a, b, c, d] = area.map((metres) => metres * 1000);
      draw.beginPath();
      if (area.length === 3) draw.arc(...to([a, b]), c * pixels, 0, 7);
      else draw.rect(...to([a, d]), (c - a) * pixels, (d - b) * pixels);
      draw.fill();
    }
    draw.strokeStyle = ink.edge;
    draw.lineWidth = 1.5;
    draw.strokeRect(left, top, width * pixels, depth * pixels);
    const time = at * 100;
    const radius = Math.max(2, data.radius_m * 1000 * pixels);
    const few = robots.length <= 300;
    for (const robot of robots) robotAt(draw, to, robot, time, radius, few);
  };
  const line = (draw, from, to) => {
    draw.beginPath();
    draw.moveTo(...from);
    draw.lineTo(...to);
    draw.stroke();
  };
  const robotAt = (draw, to, robot, time, radius, few) => {
    const spot = place(robot.driven, time);
    if (!spot) return;
    const value = lightAt(robot.light, time);
    const glow = value === 0 ? null : `#${value.toString(16).padStart(6, '0')}`;
    const [x, y] = to(spot);
    const planned = place(robot.planned, time);
    if (few && planned) {
      draw.lineWidth = 1;
      draw.strokeStyle = ink.line;
      draw.setLineDash([3, 3]);
      trail(draw, to, robot.planned, Math.max(0, time - 200), time + 200);
      draw.setLineDash([]);
      draw.beginPath();
      draw.arc(...to(planned), radius, 0, 7);
      draw.stroke();
      draw.lineWidth = 1.6;
      draw.strokeStyle = glow ?? ink.rim;
      trail(draw, to, robot.driven, Math.max(0, time - 200), time);
    }
    draw.beginPath();
    draw.arc(x, y, radius, 0, 7);
    draw.fillStyle = ink.body;
    draw.fill();
    draw.lineWidth = 1;
    draw.strokeStyle = ink.rim;
    draw.stroke();
    if (glow) {
      draw.beginPath();
      draw.arc(x, y, radius * 0.72, 0, 7);
      draw.fillStyle = glow;
      if (few) {
        draw.shadowColor = glow;
        draw.shadowBlur = radius * 1.6;
      }
      draw.fill();
      draw.shadowBlur = 0;
    }
    if (robot.lost !== null && time >= robot.lost) {
      draw.lineWidth = 2;
      draw.strokeStyle = ink.care;
      draw.beginPath();
      draw.arc(x, y, radius + 4, 0, 7);
      draw.stroke();
      line(draw, [x - radius, y - radius], [x + radius, y + radius]);
      line(draw, [x + radius, y - radius], [x - radius, y + radius]);
    }
  };

  const clock = (seconds) => {
    const tenths = Math.round(seconds * 10);
    return `${Math.floor(tenths / 600)}:${String(Math.floor(tenths / 10) % 60).padStart(2, '0')}.${tenths % 10}`;
  };
  const blocks = Array.from(document.querySelectorAll('.blocks i'));
  const show = (seconds) => {
    at = Math.min(data.end_s, Math.max(0, seconds));
    slider.value = String(at);
    $('now').textContent = clock(at);
    let name = '';
    for (const block of blocks) {
      const on = at >= Number(block.dataset.from) && at < Number(block.dataset.to);
      block.classList.toggle('on', on);
      if (on) name = `, ${block.textContent}`;
    }
    slider.setAttribute('aria-valuetext', clock(at) + name);
    paint();
  };
  const tick = (stamp) => {
    if (!running) return;
    show(at + ((stamp - last) / 1000) * speed);
    last = stamp;
    if (at >= data.end_s) run(false);
    else requestAnimationFrame(tick);
  };
  const run = (on) => {
    running = on;
    play.setAttribute('aria-pressed', String(on));
    play.setAttribute('aria-label', on ? 'Pause the replay' : 'Play the replay');
    if (!on) return;
    if (at >= data.end_s) show(0);
    last = performance.now();
    requestAnimationFrame(tick);
  };
  play.addEventListener('click', () => run(!running));
  slider.addEventListener('input', () => show(Number(slider.value)));
  for (const button of document.querySelectorAll('[data-speed]')) {
    button.addEventListener('click', () => {
      speed = Number(button.dataset.speed);
      for (const other of document.querySelectorAll('[data-speed]')) other.setAttribute('aria-pressed', String(other === button));
    });
  }
  for (const button of document.querySelectorAll('[data-at]')) {
    button.addEventListener('click', () => {
      run(false);
      show(Number(button.dataset.at));
      canvas.scrollIntoView({ block: 'center' });
    });
  }
  document.addEventListener('keydown', (event) => {
    const inField = event.target.closest('button, input, a, [tabindex]');
    if (event.key === ' ' && !inField) {
      event.preventDefault();
      run(!running);
    }
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step && !inField) show(at + step);
  });

  const keyOf = (row, column) => row.cells[column].dataset.key ?? row.cells[column].textContent;
  for (const button of document.querySelectorAll('.sort')) {
    button.addEventListener('click', () => {
      const head = button.closest('th');
      const up = head.getAttribute('aria-sort') !== 'ascending';
      for (const other of head.parentNode.cells) other.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
      const body = head.closest('table').tBodies[0];
      const order = new Intl.Collator('en', { numeric: true });
      const column = head.cellIndex;
      const compare = (a, b) => {
        const [one, other] = [keyOf(a, column), keyOf(b, column)];
        const numbers = column > 0 ? Number(one) - Number(other) : order.compare(one, other);
        return up ? numbers : -numbers;
      };
      body.append(...Array.from(body.rows).sort(compare));
    });
  }
  for (const time of document.querySelectorAll('time[data-ms]')) {
    const moment = new Date(Number(time.dataset.ms));
    time.textContent = moment.toLocaleString(undefined, { dateStyle: 'full', timeStyle: 'short' });
  }
  new ResizeObserver(paint).observe(canvas);
  show(0);
  unpack();
})();
