//! The look of the page: system type, light and dark, narrow and wide, screen and paper.

/// Style sheet of the page.
pub(super) const CSS: &str = r#"
:root { color-scheme: light dark; --ground: #ffffff; --ink: #1c1c1e; --soft: #5c5f66; --line: #d9dbe0;
  --panel: #f5f6f8; --link: #005a9c; --yes: #00694c; --partly: #8a5a00; --no: #a03c00; }
@media (prefers-color-scheme: dark) { :root { --ground: #16181c; --ink: #e8e8ea; --soft: #a3a7af;
  --line: #393d45; --panel: #20232a; --link: #7cc4f5; --yes: #4fd0a5; --partly: #f0bb4d; --no: #ff9a5c; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 62rem; padding: 1.5rem 1.25rem 4rem; background: var(--ground);
  color: var(--ink); font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0.5rem 0 1rem; }
h2 { font-size: 1.4rem; margin: 2.6rem 0 0.8rem; padding-bottom: 0.3rem; border-bottom: 1px solid var(--line); }
h3 { font-size: 1.1rem; margin: 1.8rem 0 0.5rem; }
p, li, blockquote { max-width: 46rem; }
.lead { font-size: 1.15rem; font-weight: 600; }
blockquote { margin: 0.3rem 0; padding-left: 0.8rem; border-left: 3px solid var(--line); color: var(--soft); }
.fact h3 .badge { margin-left: 0.4rem; }
sub, sup { line-height: 0; }
a { color: var(--link); }
nav { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 0.7rem 1rem; }
nav ol { margin: 0; padding-left: 1.4rem; columns: 18rem auto; }
figure { margin: 1.6rem 0; }
/* Figures are drawn on white; the frame keeps them from glaring in the dark. */
figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; padding: 0.4rem; background: #fff;
  border: 1px solid var(--line); border-radius: 8px; }
figcaption { margin: 0.6rem auto 0; max-width: 50rem; font-size: 0.94rem; }
.files { color: var(--soft); white-space: nowrap; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: 0.93rem; }
th, td { padding: 0.45rem 0.65rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
thead th.number { text-align: right; }
thead th { background: var(--panel); border-bottom: 2px solid var(--line); white-space: nowrap; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.badge { display: inline-block; padding: 0.05rem 0.55rem; border: 1.5px solid; border-radius: 1rem;
  font-size: 0.85rem; font-weight: 600; line-height: 1.35; }
.yes { color: var(--yes); }
.partly { color: var(--partly); border-style: dashed; }
.no { color: var(--no); border-style: double; border-width: 3px; }
pre { overflow-x: auto; padding: 0.8rem 1rem; background: var(--panel); border: 1px solid var(--line);
  border-radius: 8px; font: 0.87rem/1.5 ui-monospace, SFMono-Regular, Consolas, "DejaVu Sans Mono", monospace; }
details { margin: 1rem 0; padding: 0.5rem 1rem; border: 1px solid var(--line); border-radius: 8px; }
summary { cursor: pointer; font-weight: 600; }
@media (max-width: 40rem) {
  body { padding: 1rem 0.8rem 3rem; }
  /* a figure keeps a width at which its type is read, and is moved sideways */
  figure img { min-width: 38rem; }
  table, tbody, tr, td { display: block; } thead { display: none; }
  tr { padding: 0.4rem 0; border-bottom: 1px solid var(--line); }
  td { padding: 0.1rem 0; border: none; text-align: left; white-space: normal; }
  td::before { content: attr(data-name) ": "; color: var(--soft); }
  td[data-name=""]::before { content: none; }
}
@media print { :root { color-scheme: light; --ground: #fff; --ink: #000; --soft: #444; --line: #bbb; --panel: #fff;
    --link: #000; --yes: #000; --partly: #000; --no: #000; }
  body { max-width: none; padding: 0; font-size: 10.5pt; } nav { display: none; }
  figure, tr, pre { break-inside: avoid; } h2, h3 { break-after: avoid; } figure img { border: none; padding: 0; } }
"#;
