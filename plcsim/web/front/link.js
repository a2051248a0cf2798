// The one connection to the controller: questions with answers, and what it tells by itself.

export class Link extends EventTarget {
  constructor() {
    super();
    this.values = new Map();
    this.user = null;
    this.facts = null;
    this.forces = [];
    this.status = null;
    this.isOpen = false;
    this._socket = null;
    this._next = 1;
    this._open = new Map();
    this._watchers = new Set();
    this._watched = [];
    this._topics = new Map();
    this._pause = 500;
    this._timer = 0;
  }

  connect() {
    clearTimeout(this._timer);
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/live`);
    socket.binaryType = "arraybuffer";
    this._socket = socket;
    socket.onmessage = (event) => this._took(event.data);
    socket.onclose = (event) => this._closed(event);
  }

  ask(act, args = {}) {
    return new Promise((resolve, reject) => {
      if (this._socket?.readyState !== WebSocket.OPEN) {
        reject(new Error("not connected to the controller"));
        return;
      }
      const id = this._next++;
      this._open.set(id, { resolve, reject });
      this._socket.send(JSON.stringify({ ...args, id, do: act }));
    });
  }

  // calls changed(path, value) for every new value of the paths; returns what ends it
  watch(paths, changed) {
    const watcher = { paths: new Set(paths), changed };
    this._watchers.add(watcher);
    this._plan();
    for (const path of watcher.paths) if (this.values.has(path)) changed(path, this.values.get(path));
    return { end: () => { this._watchers.delete(watcher); this._plan(); } };
  }

  follow(topic) {
    this._topics.set(topic, (this._topics.get(topic) ?? 0) + 1);
    this._follow();
    return { end: () => {
      const left = this._topics.get(topic) - 1;
      if (left) this._topics.set(topic, left); else this._topics.delete(topic);
      this._follow();
    } };
  }

  may(role) {
    const roles = ["look", "operate", "engineer"];
    return this.user !== null && roles.indexOf(this.user.role) >= roles.indexOf(role);
  }

  forceOf(path) {
    return this.forces.find((f) => f.path === path || path.startsWith(`${f.path}.`) || path.startsWith(`${f.path}[`));
  }

  _plan() {
    clearTimeout(this._planned);
    this._planned = setTimeout(() => this._sendWatch(), 20);
  }

  async _sendWatch() {
    if (!this.isOpen) return;
    const paths = [...new Set([...this._watchers].flatMap((w) => [...w.paths]))].slice(0, 2000);
    this._watched = paths;
    for (const path of this.values.keys()) if (!paths.includes(path)) this.values.delete(path);
    try {
      await this.ask("watch", { tags: paths });
    } catch (error) {
      this._emit("fault", error.message);
    }
  }

  _follow() {
    if (this.isOpen) this.ask("follow", { topics: [...this._topics.keys()] }).catch(() => {});
  }

  _took(data) {
    if (typeof data !== "string") {
      this._emit("trace", data);
      return;
    }
    const message = JSON.parse(data);
    if (message.id !== undefined && message.push === undefined) {
      const open = this._open.get(message.id);
      this._open.delete(message.id);
      if (message.error !== undefined) open?.reject(new Error(message.error));
      else open?.resolve(message.ok);
      return;
    }
    this[`_push_${message.push}`]?.(message);
    this._emit(message.push, message);
  }

  _push_hello(message) {
    this.isOpen = true;
    this._pause = 500;
    this.user = message.user;
    this.facts = message.facts;
    this._sendWatch();
    this._follow();
  }

  _push_status(message) { this.status = message; }

  _push_forces(message) { this.forces = message.forces; }

  _push_values(message) {
    for (const [at, value] of message.values) {
      const path = this._watched[at];
      this.values.set(path, value);
      for (const watcher of this._watchers) if (watcher.paths.has(path)) watcher.changed(path, value);
    }
  }

  _closed(event) {
    this.isOpen = false;
    for (const { reject } of this._open.values()) reject(new Error("the connection is lost"));
    this._open.clear();
    this._emit("closed", event.code);
    if (event.code === 4401) return; // who logs in connects again
    this._timer = setTimeout(() => this.connect(), this._pause);
    this._pause = Math.min(5000, this._pause * 1.6);
  }

  _emit(type, detail) { this.dispatchEvent(new CustomEvent(type, { detail })); }
}

export const link = new Link();

// listens for as long as a page is shown; a page ends all of it at once
export class Ears {
  constructor() { this._ends = []; }

  on(type, heard) {
    const listener = (event) => heard(event.detail);
    link.addEventListener(type, listener);
    this._ends.push(() => link.removeEventListener(type, listener));
  }

  keep(handle) { this._ends.push(() => handle.end()); return handle; }

  every(ms, act) {
    const timer = setInterval(act, ms);
    this._ends.push(() => clearInterval(timer));
  }

  later(act) { this._ends.push(act); }

  end() { for (const end of this._ends.splice(0)) end(); }
}
