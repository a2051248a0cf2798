// Colours for sources: comments, texts, numbers and keywords of Structured Text, C and Python.
// It looks at one line after the other and remembers only whether a comment is still open.

const words = (text) => new Set(text.split(" "));

const ST = words("ABSTRACT ACTION AND AT BY CASE CLASS CONFIGURATION CONSTANT CONTINUE DO ELSE ELSIF END_ACTION END_CASE END_CLASS END_CONFIGURATION END_FOR END_FUNCTION END_FUNCTION_BLOCK END_IF END_INTERFACE END_METHOD END_NAMESPACE END_PROGRAM END_REPEAT END_RESOURCE END_STRUCT END_TYPE END_UNION END_VAR END_WHILE EXIT EXTENDS FALSE FINAL FOR FUNCTION FUNCTION_BLOCK IF IMPLEMENTS INTERFACE METHOD MOD NAMESPACE NOT NULL OF OR PERSISTENT POINTER PRIVATE PROGRAM PROTECTED PUBLIC REFERENCE REF_TO REPEAT RESOURCE RETAIN RETURN STRUCT SUPER TASK THEN THIS TO TRUE TYPE UNION UNTIL VAR VAR_ACCESS VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL VAR_INPUT VAR_IN_OUT VAR_OUTPUT VAR_STAT VAR_TEMP WHILE WITH XOR _CYCLIC _EXIT _INIT");
const ST_TYPES = words("ARRAY BOOL BYTE CHAR DATE DATE_AND_TIME DINT DT DWORD INT LINT LREAL LTIME LWORD REAL SINT STRING TIME TIME_OF_DAY TOD UDINT UINT ULINT USINT WCHAR WORD WSTRING");
const C = words("_CYCLIC _EXIT _GLOBAL _GLOBAL_RETAIN _INIT _LOCAL _LOCAL_RETAIN auto break case catch class const continue default delete do else enum explicit extern false for friend goto if inline namespace new nullptr operator private protected public register restrict return sizeof static struct switch template this throw true try typedef typename union using virtual volatile while");
const C_TYPES = words("bool char double float int long short signed size_t unsigned void int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t plcbit plcbyte plcword plcdword plcstring BOOL BYTE DINT DWORD INT LREAL REAL SINT STRING TIME UDINT UINT USINT WORD");
const PYTHON = words("False None True and as assert async await break class continue def del elif else except finally for from global if import in is lambda match nonlocal not or pass raise return try while with yield self");
const PYTHON_TYPES = words("ARRAY BOOL BYTE DATE DATE_AND_TIME DINT DWORD INT LINT LREAL LWORD REAL SINT STRING TIME TIME_OF_DAY UDINT UINT ULINT USINT WORD WSTRING bool bytes dict float int list object set str tuple");

const NAME = "[A-Za-z_]\\w*";
const LANGUAGES = {
  st: { open: [["(*", "*)"], ["/*", "*/"]], line: "//", text: /'(?:[^'$]|\$.)*'?|"(?:[^"$]|\$.)*"?/y, number: /(?:T|TIME|LT|LTIME|D|DATE|TOD|TIME_OF_DAY|DT|DATE_AND_TIME)#[\w.:+-]+|\d+#[\dA-F_]+|\d[\d_]*(?:\.\d[\d_]*)?(?:E[+-]?\d+)?/iy, keywords: ST, types: ST_TYPES, fold: true },
  c: { open: [["/*", "*/"]], line: "//", text: /"(?:[^"\\]|\\.)*"?|'(?:[^'\\]|\\.)*'?/y, number: /0x[\da-f']+[ul]*|(?:\d[\d']*\.?\d*|\.\d+)(?:e[+-]?\d+)?[ful]*/iy, directive: /#\s*[a-z]+/y, keywords: C, types: C_TYPES },
  py: { open: [['"""', '"""'], ["'''", "'''"]], line: "#", text: /"(?:[^"\\]|\\.)*"?|'(?:[^'\\]|\\.)*'?/y, number: /0x[\da-f_]+|\d[\d_]*(?:\.\d[\d_]*)?(?:e[+-]?\d+)?/iy, keywords: PYTHON, types: PYTHON_TYPES },
};
const ENDINGS = { st: "st", var: "st", typ: "st", fun: "st", c: "c", h: "c", cpp: "c", hpp: "c", py: "py" };

// returns what turns one line after another of a file into [kind, text]; "" is plain
export function highlighter(file) {
  const language = LANGUAGES[ENDINGS[file.split(".").pop().toLowerCase()]];
  if (!language) return (line) => [["", line]];
  const name = new RegExp(NAME, "y");
  let until = "";
  const rest = (found, line, at) => {
    const end = line.indexOf(until, at);
    const behind = end < 0 ? line.length : end + until.length;
    found.push(["comment", line.slice(at, behind)]);
    if (end >= 0) until = "";
    return behind;
  };
  const matched = (pattern, line, at) => {
    if (!pattern) return "";
    pattern.lastIndex = at;
    return pattern.exec(line)?.[0] ?? "";
  };
  const word = (text) => {
    const key = language.fold ? text.toUpperCase() : text;
    return language.keywords.has(key) ? "keyword" : language.types.has(key) ? "type-name" : "";
  };
  return (line) => {
    const found = [];
    let at = 0;
    if (until) at = line.length ? rest(found, line, 0) : 0;
    while (at < line.length) {
      const opened = language.open.find(([start]) => line.startsWith(start, at));
      if (opened) {
        until = opened[1];
        const end = line.indexOf(until, at + opened[0].length);
        const behind = end < 0 ? line.length : end + until.length;
        found.push(["comment", line.slice(at, behind)]);
        if (end >= 0) until = "";
        at = behind;
        continue;
      }
      if (line.startsWith(language.line, at)) { found.push(["comment", line.slice(at)]); break; }
      let kind = "text";
      let text = matched(language.text, line, at);
      if (!text) { kind = "number"; text = matched(language.number, line, at); }
      if (!text) { kind = "keyword"; text = matched(language.directive, line, at); }
      if (!text) { text = matched(name, line, at); kind = text ? word(text) : ""; }
      if (!text) text = line[at];
      const last = found[found.length - 1];
      if (kind === "" && last?.[0] === "") last[1] += text; else found.push([kind, text]);
      at += text.length;
    }
    return found;
  };
}
