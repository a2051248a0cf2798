// Values and times as people read them.

const BASES = { hex: 16, bin: 2, oct: 8 };
export const FORMATS = ["dec", "hex", "bin", "oct", "char"];

export function duration(ns) {
  if (ns === undefined || ns === null) return "";
  const us = ns / 1000;
  if (us < 1000) return `${us < 10 ? us.toFixed(2) : us.toFixed(1)} µs`;
  if (us < 1e6) return `${(us / 1000).toPrecision(3)} ms`;
  return `${(us / 1e6).toPrecision(4)} s`;
}

export function uptime(ns) {
  const s = Math.floor(ns / 1e9);
  const two = (n) => String(n).padStart(2, "0");
  const days = Math.floor(s / 86400);
  return `${days ? `${days} d ` : ""}${two(Math.floor(s / 3600) % 24)}:${two(Math.floor(s / 60) % 60)}:${two(s % 60)}`;
}

export function bytes(count) {
  if (count < 1024) return `${Math.round(count)} B`;
  const units = ["KiB", "MiB", "GiB"];
  let value = count;
  let at = -1;
  do { value /= 1024; at += 1; } while (value >= 1024 && at < 2);
  return `${value < 10 ? value.toFixed(1) : Math.round(value)} ${units[at]}`;
}

export function count(number) {
  return Number(number).toLocaleString("en").replaceAll(",", " ");
}

function inBase(value, base, kind) {
  const [, size, sign] = kind.split(" ");
  let number = BigInt(value);
  if (sign === "signed" && number < 0n) number += 1n << BigInt(size);
  const digits = number.toString(base).toUpperCase();
  const width = base === 16 ? size / 4 : base === 2 ? Number(size) : 0;
  const padded = digits.padStart(width, "0");
  return `${base}#${padded.replace(/(?<=.)(?=(?:.{4})+$)/g, "_")}`;
}

export function shown(value, kind, format = "dec") {
  if (value === null || value === undefined) return "…";
  if (kind === "bool") return value ? "TRUE" : "FALSE";
  if (kind === "string") return literal(value);
  if (kind === "real" && typeof value === "number") {
    return Number.isInteger(value) && Math.abs(value) < 1e15 ? value.toFixed(1) : String(Number(value.toPrecision(9)));
  }
  if (kind?.startsWith("integer")) {
    if (format === "char") return `'${String.fromCodePoint(Number(value) & 0xff)}'`;
    if (BASES[format]) return inBase(value, BASES[format], kind);
  }
  return String(value);
}

// a STRING as Structured Text writes it
function literal(value) {
  const escaped = String(value).replace(/[$']/g, (sign) => `$${sign}`);
  return `'${escaped.replace(/[\x00-\x1f\x7f-\x9f]/g, (sign) => `$${sign.charCodeAt(0).toString(16).toUpperCase().padStart(2, "0")}`)}'`;
}

// a value as Structured Text writes it, for the field in which it is changed
export function editable(value, kind) {
  if (value === null || value === undefined) return "";
  if (kind === "bool") return value ? "TRUE" : "FALSE";
  if (kind === "string") return literal(value);
  return String(value);
}
