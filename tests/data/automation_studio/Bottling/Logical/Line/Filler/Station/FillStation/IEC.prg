<?xml version="1.0" encoding="utf-8"?>
<?AutomationStudio Version=4.12.2.93 SP?>
<Program SubType="IEC" xmlns="http://br-automation.co.at/AS/Program">
  <Objects>
    <Object Type="File" Description="Init code">Init.st</Object>
    <Object Type="File" Description="Cyclic code">CYCLIC.ST</Object>
    <Object Type="File" Private="true">Variables.var</Object>
    <Object Type="Package">Actions</Object>
    <Object Type="File" Reference="true">\Logical\Docs\Exit.st</Object>
  </Objects>
</Program>